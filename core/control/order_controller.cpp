#include "core/control/order_controller.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/constants.h"
#include "core/control/controller.h"

namespace irk {

namespace {

/// Chooses the member with the most progress per work. Every kMinStay accepted steps it determines the errors e_q of
/// the member below and of the member above. The error below comes from the estimate; for the one above it is assumed
/// that the ratio of errors stays the same, as the coefficients of a smooth solution decay. From e_q follows the step
/// h_q ~ e_q^(-1/(q+1)), from the step Newton's contraction, which grows with it, and from the contraction the
/// iterations and the work. No member is chosen if Newton would contract badly with its step (Hairer & Wanner, J.
/// Comput. Appl. Math. 111, 1999, decide by the contraction alone). After two failures of Newton in a row the member
/// below is tried, whose equations have less round-off, but not in the first step, whose size is a guess.
class LeastWork final : public OrderController {
 public:
  explicit LeastWork(OrderSetup setup) : setup_(std::move(setup)) {}

  void begin() override { since_change_ = 0; }
  std::size_t afterFailure(std::size_t at, int failures, bool solved) override {
    if (!solved || failures <= 1 || at == 0) return at;
    since_change_ = 0;
    return at - 1;
  }
  bool needsLower() const override { return (since_change_ + 1) % kMinStay.whole() == 0; }
  OrderDecision decide(const OrderFacts& facts) override {
    ++since_change_;
    const std::size_t at = facts.at;
    const OrderDecision same{at, facts.h_next, facts.error};
    if (std::isnan(facts.lower) && at > 0) return same;
    if (setup_.members.size() == 1 || since_change_ % kMinStay.whole() != 0) return same;
    const auto next = best(facts);
    if (next.next == at) return same;
    since_change_ = 0;
    return next;
  }

 private:
  struct Plan {
    double h, error;
    double progress;  ///< h per work; 0: must not be chosen
  };
  // The step that the member would take next with this estimate, and its progress per work.
  Plan plan(double estimate, const OrderMember& m, const OrderFacts& now, double trend) const {
    const double error = estimate * m.strictness;
    const double s = m.stages;
    const double wish = kSafety * trend * std::pow(std::max(error, kTinyError), -1.0 / (m.order + 1));
    const double ratio = std::clamp(wish, kShrinkAtMost.value, kGrowAtMost.value);
    Plan plan{now.h * ratio, error, 0};
    // Newton's contraction grows with the step. Below that with which Jacobians are kept one iteration does.
    const double before = std::max(now.theta, NewtonOptions{}.keep_jacobian_below);
    const double theta = before * ratio;
    if (theta > kSlowContraction) return plan;
    const double decades = now.newton_iterations * std::log(1 / before);
    const double iterations = now.theta > 0 ? std::max(1.0, decades / std::log(1 / theta)) : now.newton_iterations;
    const double work = (iterations + setup_.unknowns / kUnknownsPerCost) * s + kCostPerStep;
    plan.progress = plan.h / work;
    return plan;
  }
  OrderDecision best(const OrderFacts& facts) const {
    const auto& [members, unknowns, weight] = setup_;
    const std::size_t at = facts.at;
    const double error = std::max(facts.error, kTinyError);
    // The controller's reduction for the trend of the error applies to all members.
    const double untrended = facts.h * kSafety * std::pow(error, -1.0 / (members[at].order + 1));
    const double trend = std::min(1.0, facts.h_next / untrended);
    const double estimate = error / members[at].strictness;
    Plan best = plan(estimate, members[at], facts, trend);
    best.progress *= kKeepUpTo;
    std::size_t next = at;
    const auto consider = [&](std::size_t i, double e) {
      const Plan p = plan(e, setup_.members[i], facts, trend);
      if (p.progress > best.progress) next = i, best = p;
    };
    if (at > 0) consider(at - 1, facts.lower);
    const double s = members[at].stages;
    const double below = at > 0 ? members[at - 1].stages : s - 1;
    const double ratio = at > 0 ? std::min(estimate / facts.lower, 1.0) : 0.1;
    if (at + 1 < members.size()) {
      const double more = (members[at + 1].stages - s) / (s - below);
      consider(at + 1, estimate * std::pow(ratio, more) * weight(at + 1) / weight(at));
    }
    return {next, best.h, best.error};
  }

  OrderSetup setup_;
  int since_change_ = 0;  // accepted steps
};

}  // namespace

Strategy<OrderControl> fixedOrder() { return {OrderControl::kFixed, "one number of stages", {}, nullptr}; }
Strategy<OrderControl> variableOrder() {
  return {OrderControl::kVariable,
          "the method's family, up to max_stages: the least work per unit step",
          {.embedded_estimate = true},
          kConstruct<LeastWork>};
}

}  // namespace irk
