#include "core/step_attempt.h"

#include <cmath>
#include <limits>

#include "core/multiprecision.h"

namespace irk {
namespace {

/// No estimate: one step.
template <class Real>
class Single final : public StepAttempt<Real> {
 public:
  template <class... Args>
  explicit Single(Args&&... args) : stepper_(std::forward<Args>(args)...) {}

  AttemptResult attempt(const State<Real>& from, const Real& h, State<Real>& to) override {
    const NewtonResult r = stepper_.attempt(stepper_.stages(), from, h, to);
    return {r.outcome, std::numeric_limits<double>::quiet_NaN(), r.iterations};
  }
  void rejected() override { stepper_.forget(); }

 private:
  Stepper<Real> stepper_;
};

/// Paper (5.1)-(5.4): one step h against two steps h/2, which are the result;
///   error = |V_h - V_{h/2}| / (2^p - 1).
/// The half steps are a stepper of their own: both keep their factors. Unless the paper's start
/// values are asked for, the half steps start from the whole step's polynomial, which spans them.
template <class Real>
class Doubling final : public StepAttempt<Real> {
 public:
  Doubling(const System<Real>& system, const Scheme<Real>& scheme,
           const IntegratorOptions& options, SharedJacobian<Real>& jacobian,
           const ErrorNorm<Real>& norm, Counters& counters)
      : whole_(system, scheme, options, jacobian, norm, counters),
        half_(system, scheme, options, jacobian, norm, counters),
        norm_(norm),
        divisor_(std::pow(2.0, scheme.tableau.order) - 1),
        interpolate_(options.predictor == Predictor::kExtrapolated),
        coarse_(system.sizes()),
        middle_(system.sizes()) {}

  AttemptResult attempt(const State<Real>& from, const Real& h, State<Real>& to) override {
    AttemptResult result;
    const Real half = h / Real(2);
    const auto done = [&](const NewtonResult& newton) {
      result.newton_iterations += newton.iterations;
      result.outcome = newton.outcome;
      return newton.outcome == Outcome::kSuccess;
    };
    if (!done(whole_.attempt(whole_.stages(), from, h, coarse_))) return result;
    const auto& past = interpolate_ ? whole_.stages() : half_.stages();
    if (!done(half_.attempt(past, from, half, middle_, JacobianUse::kKeep))) return result;
    if (!done(half_.attempt(past, middle_, half, to, JacobianUse::kKeep))) return result;
    result.error = norm_.difference(coarse_, to, static_cast<double>(h)) / divisor_;
    if (!std::isfinite(result.error)) result.outcome = Outcome::kNotFinite;
    return result;
  }
  void rejected() override {
    whole_.forget();
    half_.forget();
  }

 private:
  Stepper<Real> whole_, half_;
  const ErrorNorm<Real>& norm_;
  double divisor_;
  bool interpolate_;
  State<Real> coarse_, middle_;
};

}  // namespace

template <class Real>
std::unique_ptr<StepAttempt<Real>> makeStepAttempt(const System<Real>& system,
                                                   const Scheme<Real>& scheme,
                                                   const IntegratorOptions& options,
                                                   SharedJacobian<Real>& jacobian,
                                                   const ErrorNorm<Real>& norm,
                                                   Counters& counters) {
  switch (options.step.estimate) {
    case ErrorEstimate::kNone:
      return std::make_unique<Single<Real>>(system, scheme, options, jacobian, norm, counters);
    case ErrorEstimate::kDoubling:
      return std::make_unique<Doubling<Real>>(system, scheme, options, jacobian, norm, counters);
  }
  return nullptr;
}

template std::unique_ptr<StepAttempt<double>> makeStepAttempt(
    const System<double>&, const Scheme<double>&, const IntegratorOptions&,
    SharedJacobian<double>&, const ErrorNorm<double>&, Counters&);
template std::unique_ptr<StepAttempt<mp50>> makeStepAttempt(const System<mp50>&,
                                                            const Scheme<mp50>&,
                                                            const IntegratorOptions&,
                                                            SharedJacobian<mp50>&,
                                                            const ErrorNorm<mp50>&, Counters&);

}  // namespace irk
