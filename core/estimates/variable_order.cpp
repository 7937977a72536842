#include "core/estimates/variable_order.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "irk/multiprecision.h"

namespace irk {

IRK_STRATEGIES(OrderControl, "order")

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
// The order is reconsidered every kMinStay accepted steps.
constexpr int kMinStay = 7;
// Progress per work must grow by this factor: new factors, worse start values.
constexpr double kGain = 1.2;
// Members so far above are looked at; the decay of their errors is less certain than that below.
constexpr std::size_t kAbove = 2;
constexpr double kDecayAbove = 0.9;
// Measured: the first number of stages, and how many more for each decade of the tolerance.
constexpr double kStagesAtOne = 2.51, kStagesPerDecade = 0.7;
// Failures of Newton that tell of the first step's size only: it is halved by each.
constexpr int kFirstStepFailures = 12;
// Newton's contraction: a step beyond the upper bound is not planned.
constexpr double kMinContraction = 1e-4, kMaxContraction = 0.5;
// Measured, in units of one stage in one iteration. What a step costs besides its iterations, per
// stage: start values and end; the factorizations, by unknown; and for itself: Jacobian, estimate,
// control.
constexpr double kStepPerStage = 0.4, kFactors = 16, kStepAlone = 8;
constexpr double kRoundOffUnits = 1e4;
constexpr double kStricter = 1.25;
constexpr double kSafety = 0.9, kShrinkAtMost = 0.2, kGrowAtMost = 8, kTinyError = 1e-300;

// A solution of order 2s - 1 is much better than its estimate of order s + 1, and the more so the
// larger s is: at equal estimates the steps of the lower members would make all of the error (kepler,
// tolerance 1e-8: 300 times as much as with nine stages throughout). The members err alike with
// estimates below tol^(r (s + 1) / s), as RADAU has it; r such that the highest member has the
// tolerance itself. Measured: a quarter more than that. Not below round-off. Returned: by what the
// estimate is multiplied, >= 1.
template <class Real>
double exigence(Index member, Index highest, const Tolerances& tolerances) {
  const auto per_order = [](Index s) { return (static_cast<double>(s) + 1) / static_cast<double>(s); };
  const double tolerance = std::max(tolerances.rtol, tolerances.atol);
  const double least = kRoundOffUnits * static_cast<double>(Eigen::NumTraits<Real>::epsilon());
  const double more = per_order(member) / per_order(highest) - 1;
  const double own = std::pow(tolerance, 1 + kStricter * more);
  return std::max(1.0, tolerance / std::max(own, least));
}

}  // namespace

Index firstStages(const Tolerances& tolerances) {
  const double tolerance = std::max(tolerances.rtol, tolerances.atol);
  const double wish = kStagesAtOne - kStagesPerDecade * std::log10(std::min(tolerance, 1.0));
  return 2 * std::lround((wish - 1) / 2) + 1;
}

template <class Real>
VariableOrder<Real>::VariableOrder(const StepAttemptSetup<Real>& setup)
    : setup_(setup),
      members_(setup.schemes.size()),
      jacobian_(setup.jacobian),
      start_(setup.start),
      at_(start_),
      past_at_(start_),
      lower_error_(kUnknown),
      unknowns_(static_cast<double>(setup.system.sizes().n())) {
  const Index highest = setup.schemes.tableau(setup.schemes.size() - 1).stages();
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Tableau<Real>& tableau = setup.schemes.tableau(i);
    ranks_.push_back({static_cast<double>(tableau.stages()), EmbeddedEstimate<Real>::order(tableau),
                      exigence<Real>(tableau.stages(), highest, setup.options.tolerances), kUnknown});
  }
  make(start_);
  past_ = &member().stepper.stages();
}

template <class Real>
void VariableOrder<Real>::make(std::size_t i) {
  if (members_[i]) return;
  members_[i] = std::make_unique<Member>(setup_, setup_.schemes[i]);
  members_[i]->epoch = epoch_;
  if (reserved_) members_[i]->stepper.reserve(), members_[i]->estimate.reserve();
}

template <class Real>
double VariableOrder<Real>::muOf(std::size_t i) {
  double& mu = ranks_[i].mu;
  if (std::isnan(mu)) mu = static_cast<double>(EmbeddedEstimate<Real>::weight(setup_.schemes.tableau(i)));
  return mu;
}

template <class Real>
AttemptResult VariableOrder<Real>::attempt(const State<Real>& from, const Real& h, State<Real>& to) {
  AttemptResult result{member().stepper.attempt(*past_, from, h, to), 0};
  const auto& pattern = jacobian_.at().front().pattern;
  if (reserved_ != pattern) {
    if (!sameShape(reserved_, pattern)) {
      for (auto& m : members_) {
        if (m) m->stepper.reserve(), m->estimate.reserve();
      }
    }
    reserved_ = pattern;
  }
  if (result.outcome == Outcome::kSuccess && continues_ && member().stepper.leavesRoot(from)) {
    result.outcome = Outcome::kNewtonFailed;
  }
  if (result.outcome != Outcome::kSuccess) {
    if (++failures_ > (solved_ ? 1 : kFirstStepFailures) && at_ > 0) changeTo(at_ - 1);
    return result;
  }
  failures_ = 0;
  solved_ = true;
  past_ = &member().stepper.stages();
  past_at_ = at_;
  const double limit = again_ ? 1 / rank().exigence : std::numeric_limits<double>::infinity();
  auto estimate = member().estimate.evaluate(from, *past_, limit);
  result.outcome = estimate.outcome;
  result.added = member().adds ? estimate.error : 0;
  result.error = estimate.error * rank().exigence;
  estimate_ = result.error;
  const double factor = member().accumulation.factor(member().accumulates ? steps_ : 0, sum_);
  result.error = member().accumulation.asked(result.error, factor, static_cast<double>(from.t), static_cast<double>(h));
  result.error = worse(result.error, order(), result.mode_error, 1);
  if (watches_start_) {
    result.error = worse(result.error, order(), member().stepper.startDefect(from), 1);
  }
  lower_error_ = kUnknown;
  if (result.outcome == Outcome::kSuccess && result.error <= 1 && at_ > 0 && (since_change_ + 1) % kMinStay == 0) {
    const Index below = setup_.schemes.tableau(at_ - 1).stages();
    estimate = member().estimate.evaluateLower(from, *past_, below);
    // Where it cannot be computed the order stays; the step is good.
    if (estimate.outcome == Outcome::kSuccess) {
      lower_error_ = estimate.error * muOf(at_ - 1) / muOf(at_);
    }
  }
  again_ = !(result.error <= 1);
  return result;
}

template <class Real>
void VariableOrder<Real>::begin() {
  changeTo(start_);
  past_ = &member().stepper.stages();
  past_at_ = at_;
  solved_ = false;
  continues_ = restarted_ = watches_start_ = vague_start_ = false;
  steps_ = 0;
  sum_ = 0;
  for (auto& m : members_) {
    if (m) m->accumulation.begin();
  }
  failures_ = 0;
  forget();
}

template <class Real>
void VariableOrder<Real>::forget() {
  ++epoch_;
  forget(member());
  forget(*members_[past_at_]);
  again_ = true;
  lower_error_ = kUnknown;
}

// The step that the member would take next with this estimate, and its progress per work.
template <class Real>
auto VariableOrder<Real>::plan(double estimate, const Rank& m, const AttemptResult& now, double h, double trend) const
    -> Plan {
  const double error = estimate * m.exigence;
  const double s = m.stages;
  const double wish = kSafety * trend * std::pow(std::max(error, kTinyError), -1.0 / (m.order + 1));
  const double ratio = std::clamp(wish, kShrinkAtMost, kGrowAtMost);
  Plan plan{h * ratio, error, 0};
  // Newton's contraction grows with the step.
  const double before = std::max(now.theta, kMinContraction);
  const double theta = before * ratio;
  if (theta > kMaxContraction) return plan;
  const double decades = now.newton_iterations * std::log(1 / before);
  const double iterations = now.theta > 0 ? std::max(1.0, decades / std::log(1 / theta)) : now.newton_iterations;
  const double work = (iterations + kStepPerStage + unknowns_ / kFactors) * s + kStepAlone;
  plan.progress = plan.h / work;
  return plan;
}

template <class Real>
NextStep VariableOrder<Real>::accepted(const AttemptResult& result, double h, double h_next) {
  ++since_change_;
  // A restart at the end of this very step came first.
  if (!std::exchange(restarted_, false)) {
    watches_start_ = false;
    continues_ = continues_ || !vague_start_ || member().stepper.tellsRates();
  }
  ++steps_;
  sum_ += estimate_;
  if (std::isnan(lower_error_) && at_ > 0) return {h_next, result.error};
  if (members_.size() == 1 || since_change_ % kMinStay != 0) return {h_next, result.error};
  const double error = std::max(result.error, kTinyError);
  // What the controller has learnt of the error's trend holds for all members.
  const double untrended = h * kSafety * std::pow(error, -1.0 / (rank().order + 1));
  const double trend = std::min(1.0, h_next / untrended);
  const double estimate = error / rank().exigence;
  Plan best = plan(estimate, rank(), result, h, trend);
  best.progress *= kGain;
  std::size_t next = at_;
  const auto consider = [&](std::size_t i, double e) {
    const Plan p = plan(e, ranks_[i], result, h, trend);
    if (p.progress > best.progress) next = i, best = p;
  };
  if (at_ > 0) consider(at_ - 1, lower_error_);
  const double s = rank().stages;
  const double below = at_ > 0 ? ranks_[at_ - 1].stages : s - 1;
  const double ratio = at_ > 0 ? std::min(estimate / lower_error_, 1.0) : 0.1;
  for (std::size_t i = at_ + 1; i < members_.size() && i <= at_ + kAbove; ++i) {
    const double more = (ranks_[i].stages - s) / (s - below);
    consider(i, estimate * std::pow(ratio, kDecayAbove * more) * muOf(i) / muOf(at_));
  }
  if (next == at_) return {h_next, result.error};
  changeTo(next);
  return {best.h, best.error};
}

template <class Real>
void VariableOrder<Real>::forget(Member& m) {
  if (m.epoch == epoch_) return;
  m.stepper.forget();
  m.epoch = epoch_;
}

template <class Real>
void VariableOrder<Real>::changeTo(std::size_t next) {
  make(next);
  at_ = next;
  forget(member());
  since_change_ = 0;
}

template <class Real>
int VariableOrder<Real>::order() const {
  return rank().order;
}

IRK_INSTANTIATE_CLASS(VariableOrder)

Strategy<ErrorEstimate> embeddedEstimate() {
  return {.id = ErrorEstimate::kEmbedded,
          .meaning = "an embedded method of order s, or s - 1 with a stage at the start: one real solve, HW II (IV.8)",
          .needs = {.invertible_matrix = true,
                    .stage_order = true,
                    .kept_jacobian = true,
                    .instead = "estimate 'richardson'"},
          .sees_switches = true,
          .compares_orders = true,
          .make = makes<StepAttemptMaker, VariableOrder>()};
}

template <>
Catalogue<OrderControl>& catalogue<OrderControl>() {
  static Catalogue<OrderControl> all({
      {.id = OrderControl::kFixed, .meaning = "one number of stages"},
      {.id = OrderControl::kVariable,
       .meaning = "the method's family, up to max_stages: the least work per unit step",
       .needs = {.embedded_estimate = true},
       .several_methods = true},
  });
  return all;
}

}  // namespace irk
