#include "core/estimates/step_attempt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "core/estimates/defect.h"
#include "core/options/guards.h"
#include "irk/multiprecision.h"

namespace irk {

namespace {

// Whether the scheme and Newton's method have what the filter of the defect needs. One stage says nothing about how
// smooth the motion is.
template <class Real>
bool hasFilter(const Scheme<Real>& scheme, const IntegratorOptions& options) {
  return scheme.s > 1 && scheme.regular && scheme.first == 0 && scheme.tableau.stage_order >= 1 &&
         catalogue<NewtonKind>()[options.newton.kind].keeps_jacobian;
}

/// No estimate: one step.
template <class Real>
class Single final : public StepAttempt<Real> {
 public:
  explicit Single(const StepAttemptSetup<Real>& setup)
      : order_(setup.scheme().tableau.order),
        stepper_(setup.system, setup.scheme(), setup.options, setup.jacobian, setup.norm, setup.counters) {}

  AttemptResult attempt(const State<Real>& from, const Real& h, State<Real>& to) override {
    return {stepper_.attempt(stepper_.stages(), from, h, to), std::numeric_limits<double>::quiet_NaN()};
  }
  void forget() override { stepper_.forget(); }
  int order() const override { return order_; }
  StepPieces<Real> pieces(const State<Real>& from) const override {
    return {{{{&from, &stepper_.stages()}, {nullptr, nullptr}}}, 1};
  }

 private:
  int order_;
  Stepper<Real> stepper_;
};

/// Paper (5.1)-(5.4): one step h against two steps h/2, which are the result;
///   error = |V_h - V_{h/2}| / (2^p - 1).
/// The half steps have a stepper of their own, so that whole and half steps keep their factors. Half steps start from
/// the polynomial of the whole step, which spans them, unless the options ask for the paper's start values.
template <class Real>
class Doubling : public StepAttempt<Real> {
 public:
  explicit Doubling(const StepAttemptSetup<Real>& setup)
      : Doubling(setup, setup.system, setup.scheme(), setup.options) {}

  AttemptResult attempt(const State<Real>& from, const Real& h, State<Real>& to) override {
    AttemptResult result;
    const Real half = h / Real(2);
    const auto done = [&](const StepResult& step) {
      result.newton_iterations += step.newton_iterations;
      result.outcome = step.outcome;
      if (step.switched >= 0) result.switched = step.switched;
      result.mode_error = std::max(result.mode_error, step.mode_error);
      result.round_off = std::max(result.round_off, step.round_off);
      return step.outcome == Outcome::kSuccess;
    };
    const StepResult whole = whole_.attempt(whole_.stages(), from, h, coarse_);
    result.switch_at = whole.switch_at;
    if (!done(whole)) return result;
    const auto& past = interpolate_ ? whole_.stages() : half_.stages();
    if (!done(half_.attempt(past, from, half, middle_, JacobianUse::kKeep))) return result;
    if (keeps_pieces_) first_half_ = half_.stages();
    const double start_defect = watches_start_ && has(guards_, Guard::kRestart) ? half_.startDefect(from) : 0;
    Between between{};
    if (looks_) between = look(from, middle_);
    if (!done(half_.attempt(past, middle_, half, to, JacobianUse::kKeep))) return result;
    if (looks_) between = larger(between, look(middle_, to));
    result.error = error(coarse_, to, static_cast<double>(h));
    worst_ = norm_.worst(coarse_, to, static_cast<double>(h), factor_);
    if (!std::isfinite(result.error)) {
      result.outcome = Outcome::kNotFinite;
      return result;
    }
    // Doubling sees no error where the whole step and its halves err alike: in the wrong mode, ...
    if (has(guards_, Guard::kSwitchEffect)) result.error = worse(result.error, order_, result.mode_error, 1);
    // ... in a fast motion that both damp ...
    result.error = worse(result.error, order_, start_defect, 1);
    // ... between the stages of both, and where the halves do not show the order p of 2^p - 1.
    if (looks_) result.error = worse(result.error, order_, unresolved(between), 1);
    if (looks_ && !(result.error <= 1)) looks_->defect.forget();  // another path than that of a shorter step
    return result;
  }
  void forget() override {
    whole_.forget();
    half_.forget();
    if (looks_) looks_->defect.forget();
  }
  void begin(double length) override {
    forget();
    if (looks_) looks_->defect.begin(length);
    restarted_ = watches_start_ = false;
  }
  void restart() override {
    forget();
    restarted_ = watches_start_ = true;
  }
  NextStep accepted(const AttemptResult& result, double h, double h_next) override {
    // If this step ended with a restart, restart() was called before: the next step is the first one after it.
    if (!std::exchange(restarted_, false)) watches_start_ = false;
    return StepAttempt<Real>::accepted(result, h, h_next);
  }
  int order() const override { return order_; }
  Index worstComponent() const override { return worst_; }
  StepPieces<Real> pieces(const State<Real>& from) const override {
    return {{{{&from, &first_half_}, {&middle_, &half_.stages()}}}, 2};
  }
  void keepPieces(bool keep) override { keeps_pieces_ = keep || locates_; }

 protected:
  /// The error norm of the difference of the two solutions.
  virtual double error(const State<Real>& coarse, const State<Real>& fine, double h) const {
    return norm_.difference(coarse, fine, h, factor_);
  }
  const ErrorNorm<Real>& norm_;
  Vec<double> factor_;

 private:
  Doubling(const StepAttemptSetup<Real>& setup, const System<Real>& system, const Scheme<Real>& scheme,
           const IntegratorOptions& options)
      : norm_(setup.norm),
        factor_(doublingFactors(scheme, system, options.step.estimate)),
        whole_(system, scheme, options, setup.jacobian, setup.norm, setup.counters),
        half_(system, scheme, options, setup.jacobian, setup.norm, setup.counters),
        guards_(options.guards),
        order_(scheme.tableau.order),
        interpolate_(catalogue<Predictor>()[options.predictor].extrapolates),
        locates_(system.sizes().switches > 0 && system.discontinuity().at_switch == AtSwitch::kEnd),
        keeps_pieces_(locates_),
        coarse_(system.sizes()),
        middle_(system.sizes()) {
    if (!catalogue<ErrorEstimate>()[options.step.estimate].own_orders || !hasFilter(scheme, options)) return;
    looks_ = std::make_unique<Looks>(setup, half_.matrix());
  }

  // What is between the stages of a half step, and how smooth its polynomial is, in tolerances.
  struct Between {
    double defect = 0, roughness = 0;
  };
  static Between larger(const Between& a, const Between& b) {
    return {std::max(a.defect, b.defect), std::max(a.roughness, b.roughness)};
  }
  // Of the half step from `start` to `end`, which was solved last.
  Between look(const State<Real>& start, const State<Real>& end) {
    Between between{0, half_.roughness()};
    if (!has(guards_, Guard::kDefect)) return between;
    const auto found = looks_->defect.largest(start, half_.stages(), end);
    const bool known = found.outcome == Outcome::kSuccess;
    between.defect = known ? found.error : std::numeric_limits<double>::infinity();
    return between;
  }
  // An error of the stages' order, where half steps do not resolve the motion. Roughness must be below the tolerance,
  // or fall from the whole step to its halves: with 2^decay where the motion is smooth, with 2 at a jump of (a, k); the
  // limit is half-way between them, on a logarithmic scale. The defect must be below the tolerance, or below the
  // roughness, as where the motion is smooth.
  double unresolved(const Between& halves) {
    const double falls = std::exp2((whole_.decay() + 1.0) / 2);
    double found = 0;
    const bool smooth = has(guards_, Guard::kSmoothness);
    if (smooth && halves.roughness > 1 && whole_.roughness() < falls * halves.roughness) found = halves.roughness;
    if (halves.defect > 1 && !(halves.defect <= halves.roughness)) found = std::max(found, halves.defect);
    return found;
  }

  Stepper<Real> whole_, half_;
  // Looks between the stages of the half steps.
  struct Looks {
    Looks(const StepAttemptSetup<Real>& setup, NewtonMatrix<Real>& halves)
        : filter(setup.system, setup.scheme(), setup.options, halves, setup.norm, setup.counters),
          defect(filter, setup.scheme(), setup.system.sizes(), Defect<Real>::Start::kLookAt, setup.options.step.looks) {
    }
    EmbeddedEstimate<Real> filter;
    Defect<Real> defect;
  };
  std::unique_ptr<Looks> looks_;  // null for the paper's estimates, and without a filter
  bool watches_start_ = false;    // in the first step after a restart
  bool restarted_ = false;        // since the last accepted step
  Index worst_ = -1;
  Guards guards_;
  int order_;
  bool interpolate_;
  bool locates_;       // steps end at switches, found on the dense output
  bool keeps_pieces_;  // for the dense output
  StagePolynomial<Real> first_half_;
  State<Real> coarse_, middle_;
};

/// HOTINT: the difference of the two solutions' norms.
template <class Real>
class ScalarDoubling final : public Doubling<Real> {
 public:
  explicit ScalarDoubling(const StepAttemptSetup<Real>& setup) : Doubling<Real>(setup), zero_(setup.system.sizes()) {}

 private:
  double error(const State<Real>& coarse, const State<Real>& fine, double h) const override {
    return std::abs(this->norm_.difference(coarse, zero_, h, this->factor_) -
                    this->norm_.difference(fine, zero_, h, this->factor_));
  }
  State<Real> zero_;
};

}  // namespace

double worse(double error, int p, double other, int q) {
  if (std::isnan(other)) return std::numeric_limits<double>::infinity();
  return std::max(error, other > 1 ? std::pow(other, (p + 1.0) / q) : other);
}

template <class Real>
Vec<double> doublingFactors(const Scheme<Real>& scheme, const System<Real>& system, ErrorEstimate estimate) {
  const bool own = catalogue<ErrorEstimate>()[estimate].own_orders;
  const Sizes n = system.sizes();
  const ErrorPowers& powers = system.errorPowers();
  const int p = scheme.tableau.order;
  const int stage = std::max(scheme.tableau.stage_order, 1);
  const int differential = scheme.stiffly_accurate ? p : stage;
  int index = n.nz > 0 ? 1 : 0;
  for (const int power : powers.z) index = std::max(index, 1 + power);
  const auto orderOf = [&](Index i) {
    if (!own || index == 0) return p;
    if (i < n.nu) return index < 3 ? p : differential;
    if (i < 2 * n.nu) return index == 3 ? stage : index == 2 ? differential : p;
    const auto at = static_cast<std::size_t>(i - 2 * n.nu);
    const bool algebraic = i >= 2 * n.nu + n.nx;
    if (!algebraic && powers.x[at] == 0) return index == 1 ? p : differential;
    const int power = algebraic ? powers.z[at - static_cast<std::size_t>(n.nx)] : powers.x[at];
    if (power == 0) return index == 1 && scheme.stiffly_accurate ? p : stage;
    return std::max(stage - (power - 1), 1);
  };
  Vec<double> factor(n.components());
  for (Index i = 0; i < factor.size(); ++i) factor[i] = 1 / (std::pow(2.0, orderOf(i)) - 1);
  return factor;
}

Strategy<ErrorEstimate> richardsonEstimate() {
  return {.id = ErrorEstimate::kRichardson,
          .meaning = "doubling, each component with its own order; sees switches",
          .looks_further = true,
          .own_orders = true,
          .make = makes<StepAttemptMaker, Doubling>()};
}
Strategy<ErrorEstimate> doublingEstimate() {
  return {.id = ErrorEstimate::kDoubling,
          .meaning = "one step against two half steps (paper)",
          .make = makes<StepAttemptMaker, Doubling>()};
}
Strategy<ErrorEstimate> scalarDoublingEstimate() {
  return {.id = ErrorEstimate::kDoublingScalar,
          .meaning = "difference of the norms (HOTINT)",
          .make = makes<StepAttemptMaker, ScalarDoubling>()};
}
Strategy<ErrorEstimate> noEstimate() {
  return {.id = ErrorEstimate::kNone,
          .meaning = "no estimate: fixed steps only",
          .estimates = false,
          .make = makes<StepAttemptMaker, Single>()};
}

template Vec<double> doublingFactors(const Scheme<double>&, const System<double>&, ErrorEstimate);
template Vec<double> doublingFactors(const Scheme<BigFloat>&, const System<BigFloat>&, ErrorEstimate);

}  // namespace irk
