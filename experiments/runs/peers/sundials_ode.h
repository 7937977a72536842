// Shared by CVODE and ARKODE: y' = f(t, y).
#pragma once

#include <algorithm>

#include "experiments/runs/peers/sundials.h"

namespace irk::sundials {

/// Api has the functions of IRK_SUNDIALS_API and create(context, rates, y), set(memory), reInit(memory, rates, t, y),
/// advance(memory, t_end, y, t). kRemembers: reInit does not reset everything, so a new run needs new memory.
template <class Api>
class OdePeer final : public Peer {
 public:
  explicit OdePeer(const PeerSetup& setup) : problem_(setup.problem), solver_(setup, this, jacobian, roots) {}

  Outcome integrate(const PeerStart& start, double t_end, const PeerAccepted& accepted) override {
    auto& workspace = solver_.workspace();
    const N_Vector y = workspace.y();
    std::copy_n(start.y, problem_.layout().n, workspace.values());
    if (!solver_.memory() || (Api::kRemembers && start.new_run)) {
      void* const memory = Api::create(workspace.context(), rates, y);
      solver_.own(memory);
      Api::set(memory);
    }
    return solver_.run(
        start.t, t_end, accepted, [&](double t) { return Api::reInit(solver_.memory(), rates, t, y); },
        [&](double* t) { return Api::advance(solver_.memory(), t_end, y, t); },
        [&](double t) {
          return PeerStep{t, workspace.values()};
        });
  }

  void count(Counters& counters) const override { solver_.count(counters); }
  std::string message() const override { return solver_.workspace().message(); }

 private:
  static int rates(double t, N_Vector y, N_Vector f, void* self) {
    auto& problem = static_cast<OdePeer*>(self)->problem_;
    return statusOf(problem.rates(t, N_VGetArrayPointer(y), N_VGetArrayPointer(f)));
  }
  static int jacobian(double t, N_Vector y, N_Vector, SUNMatrix to, void* self, N_Vector, N_Vector, N_Vector) {
    auto& peer = *static_cast<OdePeer*>(self);
    return peer.solver_.fill(
        to, [&](PeerJacobian& J) { return peer.problem_.jacobian(t, N_VGetArrayPointer(y), nullptr, 0, J); });
  }
  static int roots(double t, N_Vector y, double* g, void* self) {
    auto& problem = static_cast<OdePeer*>(self)->problem_;
    problem.switching(t, N_VGetArrayPointer(y), nullptr, g);
    return statusOfRoots(t, g, problem.layout().switches);
  }

  PeerProblem& problem_;
  Solver<Api> solver_;
};

}  // namespace irk::sundials
