#include "core/stage_solver.h"

#include "core/coupled_dense.h"
#include "core/decoupled.h"
#include "core/multiprecision.h"

namespace irk {

template <class Real>
std::unique_ptr<StageSolver<Real>> makeStageSolver(StageSolverKind kind,
                                                   const StageSolverSetup<Real>& setup) {
  switch (kind) {
    case StageSolverKind::kCoupledDense:
      return std::make_unique<CoupledDense<Real>>(setup);
    case StageSolverKind::kSchur:
      return std::make_unique<Decoupled<Real>>(setup, schurForm(setup.A));
    case StageSolverKind::kEigen:
      return std::make_unique<Decoupled<Real>>(setup, eigenForm(setup.A));
  }
  return nullptr;
}

template std::unique_ptr<StageSolver<double>> makeStageSolver(StageSolverKind,
                                                              const StageSolverSetup<double>&);
template std::unique_ptr<StageSolver<mp50>> makeStageSolver(StageSolverKind,
                                                            const StageSolverSetup<mp50>&);

}  // namespace irk
