#include "core/stage_solvers/stage_solver.h"

#include <type_traits>

#include "core/stage_solvers/coupled.h"
#include "core/stage_solvers/decoupled.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

template <class Real>
std::unique_ptr<StageSolver<Real>> decoupled(const StageSolverSetup<Real>& setup,
                                             BlockForm<Real> form) {
  if constexpr (std::is_same_v<Real, double>) {
    if (!setup.pattern->full) {
      return std::make_unique<Decoupled<Real, SparseLu>>(setup, std::move(form));
    }
  }
  return std::make_unique<Decoupled<Real, DenseLu>>(setup, std::move(form));
}

template <class Real>
std::unique_ptr<StageSolver<Real>> coupledSparse(const StageSolverSetup<Real>& setup) {
  if constexpr (std::is_same_v<Real, double>) {
    return std::make_unique<Coupled<Real, SparseLu>>(setup);
  }
  throw Misuse("illegal combination: solver 'coupled_sparse' in multiprecision: KLU is for double");
}

}  // namespace

template <class Real>
std::unique_ptr<StageSolver<Real>> makeStageSolver(StageSolverKind kind,
                                                   const StageSolverSetup<Real>& setup) {
  switch (kind) {
    case StageSolverKind::kCoupledDense:
      if (!setup.pattern->full) throw Misuse("solver 'coupled_dense' with a sparse pattern");
      return std::make_unique<Coupled<Real, DenseLu>>(setup);
    case StageSolverKind::kCoupledSparse:
      return coupledSparse(setup);
    case StageSolverKind::kSchur:
      return decoupled(setup, setup.form ? *setup.form : schurForm(setup.A));
    case StageSolverKind::kEigen:
      return decoupled(setup, setup.form ? *setup.form : eigenForm(setup.A));
  }
  return nullptr;
}

template std::unique_ptr<StageSolver<double>> makeStageSolver(StageSolverKind,
                                                              const StageSolverSetup<double>&);
template std::unique_ptr<StageSolver<mp50>> makeStageSolver(StageSolverKind,
                                                            const StageSolverSetup<mp50>&);
template std::unique_ptr<StageSolver<mp100>> makeStageSolver(StageSolverKind,
                                                             const StageSolverSetup<mp100>&);

}  // namespace irk
