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
      r_(Vec<double>::Zero(system_->sizes().n())) {
  const Sizes n = system_->sizes();
  at_.emplace_back();
  Counters counters;
  const CountingSystem<double> counted(*system_, counters);
  Differentiator<double> counting(counted, spec.options.derivatives, JacobianTerms::kFull,
                                  storageOf(spec.options));
  counting.evaluate(Level::kFormulated, point(), at_.front());  // finds the pattern
  counters = {};
  counting.evaluate(Level::kFormulated, point(), at_.front());
  residuals_per_jacobian_ = counters.residuals;
  differentiator_.evaluate(Level::kFormulated, point(), at_.front());

  const Scheme<double> scheme(makeTableau<double>(spec.method));
  const Mat<double> A = scheme.implicitA();
  solver_ = makeStageSolver<double>(spec.options.solver,
                                    {A, at_.front().pattern, system_->rowPowers(), n,
                                     spec.options.threads});
  if (solver_->stagewise()) at_.resize(static_cast<std::size_t>(A.rows()), at_.front());
  rhs_ = ones_ = Mat<double>::Ones(n.n(), A.rows());
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

void NewtonKernel::solve() {
  rhs_ = ones_;
  solver_->solve(rhs_);
}

}  // namespace irk
