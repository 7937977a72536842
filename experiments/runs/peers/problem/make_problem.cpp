#include "experiments/runs/peers/problem/make_problem.h"

#include "experiments/runs/peers/problem/implicit_problem.h"
#include "experiments/runs/peers/problem/ode_problem.h"

namespace irk {

std::unique_ptr<SceneProblem> makeProblem(PeerForm form, const System<double>& system, const State<double>& start,
                                          const ProblemOptions& options) {
  switch (form) {
    case PeerForm::kOde:
      return std::make_unique<OdeProblem>(system, options);
    case PeerForm::kMass:
      return std::make_unique<MassProblem>(system, options, start);
    case PeerForm::kDae:
      return std::make_unique<DaeProblem>(system, options);
  }
  return nullptr;
}

}  // namespace irk
