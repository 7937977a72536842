#include "core/steps/stepper.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/constants.h"
#include "core/base/small_product.h"
#include "core/base/threads.h"
#include "core/options/fixed_steps.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

template <class Real>
bool hasHiddenUnknowns(const System<Real>& system) {
  const auto& powers = system.errorPowers().z;
  const auto multipliers = static_cast<std::ptrdiff_t>(system.sizes().constraints);
  return std::any_of(powers.begin() + multipliers, powers.end(), [](int power) { return power > 0; });
}

// The sum of the stages with these weights.
template <class Real, class Weights>
void addStages(const Mat<Real>& W, const Weights& weights, Vec<Real>& sum) {
  inlinedProduct(W.data(), W.rows(), W.rows(), weights, sum.data(), sum.size());
}

// Only a problem with switches has modes to settle.
template <class Real>
std::unique_ptr<ModesInStep<Real>> modesOf(const System<Real>& system, const IntegratorOptions& options,
                                           const ErrorNorm<Real>& norm, Counters& counters) {
  if (system.sizes().switches == 0) return nullptr;
  const auto& treatment = catalogue<Discontinuity>()[system.discontinuity()];
  const auto& make = treatment.in_step.template of<Real>();
  return make ? make(system, options, norm, counters) : nullptr;
}

template <class Real>
StageSolverSetup<Real> setupOf(const System<Real>& system, const Scheme<Real>& scheme,
                               const IntegratorOptions& options) {
  return {scheme.implicitA(), nullptr, system.rowPowers(), system.sizes(), options.threads};
}

}  // namespace

template <class Real>
Stepper<Real>::Stepper(const System<Real>& system, const Scheme<Real>& scheme, const IntegratorOptions& options,
                       SharedJacobian<Real>& jacobian, const ErrorNorm<Real>& norm, Counters& counters)
    : counters_(counters),
      threads_(options.threads),
      eq_(system, scheme, options.summation, options.threads),
      matrix_(jacobian, options.solver, setupOf(system, scheme, options), counters),
      stagewise_(catalogue<NewtonKind>()[options.newton.kind].uses_stage_matrices
                     ? std::make_unique<StagewiseMatrix<Real>>(jacobian, setupOf(system, scheme, options), counters)
                     : nullptr),
      newton_(makeNewton(options, system.sizes(), scheme)),
      norm_(norm),
      start_values_(options.predictor, scheme, hasFixedSteps(options.step) ? 0 : norm.tolerance()),
      W_(system.sizes().n(), scheme.s),
      modes_(modesOf(system, options, norm, counters)),
      rate_norm_(system.sizes(), norm),
      rates_(system.sizes().n()),
      has_hidden_unknowns_(hasHiddenUnknowns(system)) {
  stages_.scheme = &scheme;
  stages_.W.setZero(system.sizes().n(), scheme.s);
  if (system.projectsVelocity()) {
    projection_ = std::make_unique<VelocityProjection<Real>>(system, options.derivatives, counters);
  }
}

template <class Real>
void Stepper<Real>::solve(const State<Real>& from, const Real& h, JacobianUse use, StepResult& result) {
  eq_.begin(from, h);
  // If modes change inside a solve or from one solve to the next, the contraction of the last solve does not hold: the
  // iteration would end after one correction with the Jacobian of another mode.
  if (modes_) newton_->forget();
  start_values_.fill(*past_, from, h, W_);
  NewtonContext<Real> context{eq_, matrix_, stagewise_.get(), norm_, counters_, use};
  const NewtonResult newton = newton_->solve(context, W_);
  result.newton_iterations += newton.iterations;
  result.theta = std::max(result.theta, newton.theta);
  result.round_off = std::max(result.round_off, newton.round_off);
  result.outcome = newton.outcome;
  if (newton.outcome != Outcome::kSuccess) return;
  eq_.finish(W_, *to_);
  if (projection_) result.outcome = projection_->apply(*to_);
}

template <class Real>
void Stepper<Real>::solveAndKeep(const State<Real>& from, const Real& h, JacobianUse use, StepResult& result) {
  solve(from, h, use, result);
  stages_.valid = result.outcome == Outcome::kSuccess;
  if (!stages_.valid) return;
  stages_.t = from.t;
  stages_.h = h;
  copyOnThreads(threads_, W_.data(), W_.size(), stages_.W.data());
}

template <class Real>
void Stepper<Real>::repeat(const State<Real>& start, StepResult& result) {
  solveAndKeep(start, eq_.h(), JacobianUse::kKeep, result);
}

template <class Real>
StepResult Stepper<Real>::attempt(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h,
                                  State<Real>& to, JacobianUse use) {
  StepResult result;
  past_ = &past;
  to_ = &to;
  solveAndKeep(from, h, use, result);
  if (modes_ && result.outcome == Outcome::kSuccess) {
    SolvedStep<Real> step{from, h, to, eq_, stages_, *this};
    modes_->settle(step, result);
  }
  stages_.valid = result.outcome == Outcome::kSuccess;
  return result;
}

template <class Real>
double Stepper<Real>::startDefect(const State<Real>& from) {
  // Rates that index 2 hides are not known at a restart: (a, k) are then those of the mode before.
  if (has_hidden_unknowns_) return 0;
  addStages(W_, eq_.scheme().start, rates_);
  rates_ -= from.w;
  const double missed = rate_norm_(rates_, stages_.h);
  const double changed = rate_norm_.largestChange(W_, from.w, stages_.h);
  // In index 3 a start within the allowed drift changes velocities by as much, at any step size.
  return missed > kAllowedDrift && missed > kFollows * changed ? missed : 0;
}

template <class Real>
int Stepper<Real>::decay() const {
  return static_cast<int>(W_.cols()) - highest() + 1;
}

template <class Real>
double Stepper<Real>::roughness() {
  // One coefficient passes through zeros as a jump moves through the step; two neighbours have no zero in common.
  double sum = 0;
  for (Index k = W_.cols() - highest(); k < W_.cols(); ++k) {
    addStages(W_, eq_.scheme().legendre_inverse_transposed.col(k), rates_);
    const double size = rate_norm_(rates_, stages_.h);
    sum += size * size;
  }
  return std::sqrt(sum);
}

IRK_INSTANTIATE_CLASS(Stepper)

}  // namespace irk
