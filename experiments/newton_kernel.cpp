#include "experiments/newton_kernel.h"

#include "core/counting.h"
#include "core/scheme.h"
#include "tableaus/catalogue.h"

namespace irk {

NewtonKernel::NewtonKernel(const RunSpec& spec, double h)
    : system_(makeScene<double>(spec.scene, spec.settings)
                  .system({spec.formulation, spec.scaling, spec.discontinuity})),
      start_(system_->fromScene(makeScene<double>(spec.scene, spec.settings).start)),
      h_(h),
      differentiator_(*system_, spec.options.derivatives, JacobianTerms::kFull,
                      storageOf(spec.options)),
      at_(1),
      scheme_(makeTableau<double>(spec.method)),
      equations_(*system_, scheme_, spec.options.summation, spec.options.threads),
      r_(Vec<double>::Zero(system_->sizes().n())) {
  Counters counters;
  const CountingSystem<double> counted(*system_, counters);
  Differentiator<double> counting(counted, spec.options.derivatives, JacobianTerms::kFull,
                                  storageOf(spec.options));
  counting.evaluate(Level::kFormulated, point(), at_.front());  // finds the pattern
  counters = {};
  counting.evaluate(Level::kFormulated, point(), at_.front());
  residuals_per_jacobian_ = counters.residuals;
  jacobian();

  const Mat<double> A = scheme_.implicitA();
  const Index n = system_->sizes().n();
  solver_ = makeStageSolver<double>(spec.options.solver,
                                    {A, at_.front().pattern, system_->rowPowers(),
                                     system_->sizes(), spec.options.threads});
  if (solver_->stagewise()) at_.resize(static_cast<std::size_t>(A.rows()), at_.front());
  rhs_ = ones_ = Mat<double>::Ones(n, A.rows());
  W_ = R_ = start_.w.replicate(1, scheme_.s);
  equations_.begin(start_, h_);
}

void NewtonKernel::residual() {
  system_->evaluate(Level::kFormulated, point(), {r_.data(), r_.size()});
}

void NewtonKernel::jacobian() {
  differentiator_.evaluate(Level::kFormulated, point(), at_.front());
}

void NewtonKernel::factorize() {
  if (solver_->factorize(at_, h_) != Outcome::kSuccess) {
    throw Misuse("the Newton matrix cannot be factorized at the scene's start");
  }
}

void NewtonKernel::iteration() {
  if (!equations_.residual(W_, R_)) throw Misuse("a residual at the scene's start is not finite");
  solver_->solve(R_.rightCols(scheme_.implicitStages()));
}

void NewtonKernel::solve() {
  rhs_ = ones_;
  solver_->solve(rhs_);
}

}  // namespace irk
