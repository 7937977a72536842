#include "core/estimates/step_attempt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "core/estimates/accumulation.h"
#include "core/estimates/embedded.h"
#include "core/estimates/error_transport.h"
#include "irk/multiprecision.h"

namespace irk {

namespace {

// Bounds of the decay of roughness from a step to its halves, as powers of 2. It is at least kMinDecay and kPartOfDecay
// times the decay of a smooth solution, and at most kBeyondDecay more than that decay: a jump next to the middle is
// rough for the whole step only.
constexpr double kMinDecay = 1.25, kPartOfDecay = 0.7, kBeyondDecay = 6;
// The least factor of the estimate, the paper's s_min. The estimate is that of the kept solution, so that errors of all
// steps count.
constexpr double kReserve = 4;
// Roughness of the whole step alone counts above this many tolerances.
constexpr double kRough = 10;

template <class Real>
bool isIndex3(const System<Real>& system) {
  const auto& powers = system.errorPowers().v;
  return std::any_of(powers.begin(), powers.end(), [](int power) { return power > 0; });
}

// Whether the last stage is before the step's end and EmbeddedEstimate can be used.
template <class Real>
bool canLookIntoGaps(const Scheme<Real>& scheme, const IntegratorOptions& options) {
  return EmbeddedEstimate<Real>::endsBefore(scheme) && scheme.regular && scheme.first == 0 &&
         scheme.tableau.stage_order >= 1 && catalogue<NewtonKind>()[options.newton.kind].keeps_jacobian;
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
    if (continues_ && whole_.leavesRoot(from)) {
      result.outcome = Outcome::kNewtonFailed;
      return result;
    }
    const auto& past = interpolate_ ? whole_.stages() : half_.stages();
    if (!done(half_.attempt(past, from, half, middle_, JacobianUse::kKeep))) return result;
    if (keeps_pieces_) first_half_ = half_.stages();
    const double start_defect = watches_start_ ? half_.startDefect(from) : 0;
    if (looks_again_) {
      rough_.whole = whole_.roughness(from), rough_.halves = half_.roughness(from);
      missed_.whole = missed(whole_, from, coarse_, half), missed_.halves = missed(half_, from, middle_, half);
    }
    if (!done(half_.attempt(past, middle_, half, to, JacobianUse::kKeep))) return result;
    if (looks_again_) {
      rough_.halves = std::max(rough_.halves, half_.roughness(middle_));
      missed_.halves = std::max(missed_.halves, missed(half_, middle_, to, half));
    }
    result.error = error(coarse_, to, static_cast<double>(h));
    if (accumulates_) {
      result.added = result.error;
      result.error = accumulation_.asked(result.error, accumulation_.factor(steps_, sum_), static_cast<double>(from.t),
                                         static_cast<double>(h));
    }
    worst_ = norm_.worst(coarse_, to, static_cast<double>(h), factor_);
    if (!std::isfinite(result.error)) {
      result.outcome = Outcome::kNotFinite;
      return result;
    }
    // Doubling sees no error where the whole step and its halves err alike: in the wrong mode, ...
    result.error = worse(result.error, order_, result.mode_error, 1);
    // ... in a fast motion that both damp ...
    if (watches_start_) result.error = worse(result.error, order_, start_defect, 1);
    // ... and 2^p - 1 divides by too much where the halves do not show order p.
    if (looks_again_) result.error = worse(result.error, order_, unresolved(), 1);
    if (transport_ && result.error <= 1) transport_->carry(whole_, from, coarse_, to, factor_, norm_);
    return result;
  }
  void forget() override {
    whole_.forget();
    half_.forget();
  }
  void begin() override {
    forget();
    steps_ = 0;
    sum_ = 0;
    accumulation_.begin();
    if (transport_) transport_->begin();
    continues_ = restarted_ = watches_start_ = vague_start_ = false;
  }
  void restart() override {
    forget();
    continues_ = false;
    restarted_ = watches_start_ = vague_start_ = true;
    if (transport_) transport_->restart();
  }
  NextStep accepted(const AttemptResult& result, double h, double h_next) override {
    // If this step ended with a restart, restart() was called before: the next step is the first one after it.
    if (!std::exchange(restarted_, false)) {
      watches_start_ = false;
      continues_ = continues_ || !vague_start_ || whole_.tellsRates();
    }
    ++steps_;
    sum_ += result.added;
    if (transport_) transport_->accept();
    return StepAttempt<Real>::accepted(result, h, h_next);
  }
  CarriedError carriedError() const override {
    if (!transport_) return {};
    return {transport_->size(norm_), transport_->amplification(norm_)};
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
        accumulates_(ownOrders(options) && !isIndex3(system)),
        accumulation_(std::max(kReserve, stiffCaution(scheme)), options.tolerances),
        looks_again_(ownOrders(options) && scheme.s > 1),
        order_(scheme.tableau.order),
        interpolate_(catalogue<Predictor>()[options.predictor].extrapolates),
        locates_(system.sizes().switches > 0 && system.discontinuity().at_switch == AtSwitch::kEnd),
        keeps_pieces_(locates_),
        coarse_(system.sizes()),
        middle_(system.sizes()) {
    const bool keeps = catalogue<NewtonKind>()[options.newton.kind].keeps_jacobian;
    if (ownOrders(options) && keeps && isStableAtInfinity(scheme)) {
      transport_ = std::make_unique<ErrorTransport<Real>>(system.sizes(), scheme.s);
    }
    if (!looks_again_ || !canLookIntoGaps(scheme, options)) return;
    gaps_ = std::make_unique<EmbeddedEstimate<Real>>(system, scheme, options, setup.jacobian, half_.matrix(),
                                                     setup.norm, setup.counters);
  }
  static bool ownOrders(const IntegratorOptions& options) {
    return catalogue<ErrorEstimate>()[options.step.estimate].own_orders;
  }
  // The error of a fast motion before the first stage of a step or behind the last one, which no stage shows.
  double missed(Stepper<Real>& stepper, const State<Real>& from, const State<Real>& to, const Real& filter_h) {
    if (!gaps_) return 0;
    const auto before = gaps_->missedAtStart(from, stepper.stages(), filter_h);
    const auto behind = gaps_->missedAtEnd(from, stepper.stages(), to, filter_h);
    const bool known = before.outcome == Outcome::kSuccess && behind.outcome == Outcome::kSuccess;
    if (!known) return std::numeric_limits<double>::infinity();
    const auto [less, more] = std::minmax(before.error, behind.error);
    return isNews(more, less) ? more : 0;
  }

  // A quantity of the whole step, and the larger one of its two halves.
  struct Pair {
    double whole = 0, halves = 0;
  };
  // A second check, of the order of the stages. Roughness and missed motion of the halves must be below the tolerance,
  // or fall from the whole step to its halves as those of a smooth solution do; at a jump of (a, k) they fall by 2
  // only, at a jump of their rates by 4.
  double unresolved() const {
    const double least = std::exp2(std::max(kMinDecay, kPartOfDecay * whole_.decay()));
    double found = 0;
    for (const Pair& pair : {rough_, missed_}) {
      if (pair.halves > 1 && pair.whole < least * pair.halves) found = std::max(found, pair.halves);
    }
    const double most = std::exp2(whole_.decay() + kBeyondDecay);
    if (rough_.whole > kRough && rough_.whole > most * rough_.halves) found = std::max(found, rough_.whole);
    return found;
  }

  Stepper<Real> whole_, half_;
  std::unique_ptr<ErrorTransport<Real>> transport_;  // null for the paper's estimates
  std::unique_ptr<EmbeddedEstimate<Real>> gaps_;     // null if the last stage is at the end
  bool accumulates_;  // false for the paper's estimates, and in index 3 because of round-off of velocities
  Accumulation accumulation_;
  std::int64_t steps_ = 0;      // accepted
  double sum_ = 0;              // sum of their estimates
  bool looks_again_;            // `richardson`: checks whether the halves show the order
  bool watches_start_ = false;  // in the first step after a restart
  bool restarted_ = false;      // since the last accepted step
  bool continues_ = false;      // (a, k) at a step's start belong to its mode
  bool vague_start_ = false;    // after a restart, which may not determine (a, k)
  Index worst_ = -1;
  Pair rough_, missed_;
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
template Vec<double> doublingFactors(const Scheme<mp50>&, const System<mp50>&, ErrorEstimate);
template Vec<double> doublingFactors(const Scheme<mp100>&, const System<mp100>&, ErrorEstimate);

}  // namespace irk
