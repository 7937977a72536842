#include "core/stage_solvers/stage_solver.h"

#include "irk/multiprecision.h"

namespace irk {

IRK_STRATEGIES(StageSolverKind, "solver")

Storage storageOf(const IntegratorOptions& options) {
  const Storage own = catalogue<StageSolverKind>()[options.solver].storage;
  return own == Storage::kAutomatic ? options.storage : own;
}

template <class Real>
std::shared_ptr<const BlockForm<Real>> makeBlockForm(StageSolverKind kind, const Mat<Real>& A) {
  const auto& form = catalogue<StageSolverKind>()[kind].form.template of<Real>();
  return form ? form(A) : nullptr;
}

template <class Real>
std::unique_ptr<StageSolver<Real>> makeStageSolver(StageSolverKind kind, const StageSolverSetup<Real>& setup) {
  const auto& make = catalogue<StageSolverKind>()[kind].make.template of<Real>();
  if (setup.form) return madeBy(make, kind, setup);
  StageSolverSetup<Real> with_form = setup;
  with_form.form = makeBlockForm(kind, setup.A);
  return madeBy(make, kind, with_form);
}

template std::shared_ptr<const BlockForm<double>> makeBlockForm(StageSolverKind, const Mat<double>&);
template std::shared_ptr<const BlockForm<BigFloat>> makeBlockForm(StageSolverKind, const Mat<BigFloat>&);
template std::unique_ptr<StageSolver<double>> makeStageSolver(StageSolverKind, const StageSolverSetup<double>&);
template std::unique_ptr<StageSolver<BigFloat>> makeStageSolver(StageSolverKind, const StageSolverSetup<BigFloat>&);

}  // namespace irk
