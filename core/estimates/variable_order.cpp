#include "core/estimates/variable_order.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/constants.h"
#include "core/options/guards.h"
#include "irk/multiprecision.h"

namespace irk {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// The factor >= 1 by which a member's estimate is multiplied. A solution of order 2s - 1 is much better than its
// estimate of order s + 1, the more so the larger s is. With equal estimates nearly all of the error would come from
// the steps of the lower members (kepler, tolerance 1e-8: 300 times the error of nine stages throughout). Members err
// alike with estimates below tol^(r (s + 1) / s), as in RADAU; r is chosen so that the highest member has the tolerance
// itself. Measured: the exponent has to exceed 1 by a quarter more (kMemberStrictness). The bound does not go below
// round-off.
template <class Real>
double strictness(Index member, Index highest, const Tolerances& tolerances) {
  const auto per_order = [](Index s) { return (static_cast<double>(s) + 1) / static_cast<double>(s); };
  const double tolerance = std::max(tolerances.rtol, tolerances.atol);
  const double least = kStagnationUnits * static_cast<double>(Eigen::NumTraits<Real>::epsilon());
  const double more = per_order(member) / per_order(highest) - 1;
  const double own = std::pow(tolerance, 1 + kMemberStrictness * more);
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
      lower_error_(kUnknown) {
  const Index highest = setup.schemes.tableau(setup.schemes.size() - 1).stages();
  ranks_.reserve(members_.size());
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Tableau<Real>& tableau = setup.schemes.tableau(i);
    ranks_.push_back({static_cast<double>(tableau.stages()), EmbeddedEstimate<Real>::order(tableau),
                      strictness<Real>(tableau.stages(), highest, setup.options.tolerances)});
  }
  mus_.assign(ranks_.size(), kUnknown);
  const auto unknowns = static_cast<double>(setup.system.sizes().n());
  order_control_ =
      makeOrderController(setup.options.order, {ranks_, unknowns, [this](std::size_t i) { return muOf(i); }});
  make(start_);
  past_ = &member().stepper.stages();
}

template <class Real>
void VariableOrder<Real>::make(std::size_t i) {
  if (members_[i]) return;
  members_[i] = std::make_unique<Member>(setup_, setup_.schemes[i]);
  members_[i]->epoch = epoch_;
  members_[i]->defect.begin(length_);
  if (reserved_) members_[i]->stepper.reserve(), members_[i]->estimate.reserve();
}

template <class Real>
double VariableOrder<Real>::muOf(std::size_t i) {
  double& mu = mus_[i];
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
  const auto guards = [this](Guard guard) { return has(setup_.options.guards, guard); };
  if (result.outcome != Outcome::kSuccess) {
    ++failures_;
    const std::size_t next = order_control_ ? order_control_->afterFailure(at_, failures_, solved_) : at_;
    if (next != at_) changeTo(next);
    return result;
  }
  failures_ = 0;
  solved_ = true;
  past_ = &member().stepper.stages();
  past_at_ = at_;
  const double limit = again_ ? 1 / rank().strictness : std::numeric_limits<double>::infinity();
  auto estimate = member().estimate.evaluate(from, *past_, limit);
  result.outcome = estimate.outcome;
  // Strictness multiplies the estimate alone.
  const double strict = estimate.error * rank().strictness;
  double plain = estimate.error;
  const auto raiseTo = [&](double other) { plain = worse(plain, order(), other, 1); };
  if (guards(Guard::kSwitchEffect)) raiseTo(result.mode_error);
  // What the defect shows between the stages says nothing about stiff components at the start, which a second filter
  // damps.
  again_ = !(std::max(strict, plain) <= 1);
  if (result.outcome == Outcome::kSuccess && plain <= 1 && guards(Guard::kDefect)) {
    const auto between = member().defect.largest(from, *past_, to);
    result.outcome = between.outcome;
    plain = std::max(plain, between.error);
  }
  if (watches_start_ && guards(Guard::kRestart)) raiseTo(member().stepper.startDefect(from));
  result.error = std::max(strict, plain);
  result.too_strict = result.error > 1 && plain <= 1;
  lower_error_ = kUnknown;
  const bool good = result.outcome == Outcome::kSuccess && result.error <= 1;
  if (good && at_ > 0 && order_control_->needsLower()) {
    const Index below = setup_.schemes.tableau(at_ - 1).stages();
    estimate = member().estimate.evaluateLower(from, *past_, below);
    // If it cannot be computed, the order stays the same; the step itself is good.
    if (estimate.outcome == Outcome::kSuccess) {
      lower_error_ = estimate.error * muOf(at_ - 1) / muOf(at_);
    }
  }
  return result;
}

template <class Real>
void VariableOrder<Real>::begin(double length) {
  length_ = length;
  changeTo(start_);
  if (order_control_) order_control_->begin();
  past_ = &member().stepper.stages();
  past_at_ = at_;
  solved_ = restarted_ = watches_start_ = false;
  for (auto& m : members_) {
    if (m) m->defect.begin(length);
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

template <class Real>
NextStep VariableOrder<Real>::accepted(const AttemptResult& result, double h, double h_next) {
  // If this step ended with a restart, restart() was called before: the next step is the first one after it.
  if (!std::exchange(restarted_, false)) watches_start_ = false;
  if (!order_control_) return {h_next, result.error};
  const auto decision =
      order_control_->decide({at_, result.error, lower_error_, result.theta, result.newton_iterations, h, h_next});
  if (decision.next != at_) changeTo(decision.next);
  return {decision.h, decision.error};
}

template <class Real>
void VariableOrder<Real>::forget(Member& m) {
  if (m.epoch == epoch_) return;
  m.stepper.forget();
  m.defect.forget();
  m.epoch = epoch_;
}

template <class Real>
void VariableOrder<Real>::changeTo(std::size_t next) {
  make(next);
  at_ = next;
  forget(member());
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
          .looks_further = true,
          .compares_orders = true,
          .make = makes<StepAttemptMaker, VariableOrder>()};
}

}  // namespace irk
