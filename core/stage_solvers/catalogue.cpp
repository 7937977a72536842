// The stage solvers that come with the library.
#include <type_traits>

#include "core/options/entries.h"
#include "core/stage_solvers/coupled.h"
#include "core/stage_solvers/decoupled.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

template <class Real>
std::unique_ptr<StageSolver<Real>> decoupled(const StageSolverSetup<Real>& setup) {
  if constexpr (std::is_same_v<Real, double>) {
    if (!setup.pattern->full) return std::make_unique<Decoupled<Real, SparseLu>>(setup);
  }
  return std::make_unique<Decoupled<Real, DenseLu>>(setup);
}

template <class Real>
std::unique_ptr<StageSolver<Real>> coupledDense(const StageSolverSetup<Real>& setup) {
  if (!setup.pattern->full) throw Misuse("solver 'coupled_dense' with a sparse pattern");
  return std::make_unique<Coupled<Real, DenseLu>>(setup);
}

std::unique_ptr<StageSolver<double>> coupledSparse(const StageSolverSetup<double>& setup) {
  return std::make_unique<Coupled<double, SparseLu>>(setup);
}

PerScalar<StageSolverMaker> decoupledSolvers() { return {decoupled<double>, decoupled<BigFloat>}; }

}  // namespace

Strategy<StageSolverKind> schurSolver() {
  return {.id = StageSolverKind::kSchur,
          .meaning = "real Schur form of A: s/2 complex n x n systems",
          .form = {schurForm<double>, schurForm<BigFloat>},
          .make = decoupledSolvers()};
}
Strategy<StageSolverKind> eigenSolver() {
  return {.id = StageSolverKind::kEigen,
          .meaning = "eigenvectors of A: s/2 complex n x n systems, cheapest",
          .form = {eigenForm<double>, eigenForm<BigFloat>},
          .make = decoupledSolvers()};
}
Strategy<StageSolverKind> coupledDenseSolver() {
  return {.id = StageSolverKind::kCoupledDense,
          .meaning = "one LU of the s n x s n matrix (paper)",
          .coupled = true,
          .storage = Storage::kDense,
          .make = {coupledDense<double>, coupledDense<BigFloat>}};
}
Strategy<StageSolverKind> coupledSparseSolver() {
  return {.id = StageSolverKind::kCoupledSparse,
          .meaning = "one sparse LU of the s n x s n matrix",
          .coupled = true,
          .storage = Storage::kSparse,
          .make = {coupledSparse, nullptr}};
}

IRK_CATALOGUE(StageSolverKind, schurSolver(), eigenSolver(), coupledDenseSolver(), coupledSparseSolver())

}  // namespace irk
