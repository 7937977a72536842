#include "core/stepper.h"

#include "core/multiprecision.h"

namespace irk {
namespace {

template <class Real>
StageSolverSetup<Real> setupOf(const System<Real>& system, const Scheme<Real>& scheme) {
  return {scheme.implicitA(), Pattern::dense(system.sizes().n()), system.rowPowers(),
          system.sizes()};
}

}  // namespace

template <class Real>
Stepper<Real>::Stepper(const System<Real>& system, const Scheme<Real>& scheme,
                       const IntegratorOptions& options, SharedJacobian<Real>& jacobian,
                       const ErrorNorm<Real>& norm, Counters& counters)
    : counters_(counters),
      eq_(system, scheme),
      matrix_(jacobian,
              std::make_unique<CountingStageSolver<Real>>(
                  makeStageSolver(options.solver, setupOf(system, scheme)), counters)),
      stagewise_(jacobian, setupOf(system, scheme), options.newton.kind, counters),
      newton_(makeNewton(options, system.sizes(), scheme)),
      norm_(norm),
      start_values_(options.predictor, scheme),
      W_(system.sizes().n(), scheme.s) {
  stages_.W.setZero(system.sizes().n(), scheme.s);
}

template <class Real>
NewtonResult Stepper<Real>::attempt(const StagePolynomial<Real>& past, const State<Real>& from,
                                    const Real& h, State<Real>& to, JacobianUse use) {
  eq_.begin(from, h);
  start_values_.fill(past, from, h, W_);
  NewtonContext<Real> context{eq_, matrix_, stagewise_, norm_, counters_, use};
  const NewtonResult result = newton_->solve(context, W_);
  stages_.valid = result.outcome == Outcome::kSuccess;
  if (!stages_.valid) return result;
  stages_.t = from.t;
  stages_.h = h;
  stages_.W = W_;
  eq_.finish(W_, to);
  return result;
}

IRK_INSTANTIATE_CLASS(Stepper)

}  // namespace irk
