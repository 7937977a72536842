// Strategies from outside the library, and the rules that hold for them as for its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/control/controller.h"
#include "core/stages/start_values.h"
#include "tests/core/support.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

constexpr StepControl kSteady{{"steady"}};
constexpr Predictor kZero{{"zero"}};

int g_decisions = 0, g_predictions = 0;

/// Steps of one size, shorter only where the tolerance asks for it.
class SteadyController final : public StepController {
 public:
  StepDecision decide(double error, double h) override {
    ++g_decisions;
    return {error <= 1, error <= 1 ? h : h / 2};
  }
  double afterFailure(double h) override { return h / 2; }
  void forget() override {}
  void changeOrder(int, double, double) override {}
};

/// Newton's iteration starts from zero.
class ZeroPredictor final : public StagePredictor<double> {
 public:
  void fill(const StagePolynomial<double>&, const State<double>&, const double&, Mat<double>& W) override {
    ++g_predictions;
    W.setZero();
  }
};

Strategy<StepControl> steady() {
  return {kSteady, "one size of steps", {.estimate = true}, [](const StepOptions&, int) {
            return std::make_unique<SteadyController>();
          }};
}
Strategy<Predictor> zero() {
  const auto make = [](const Scheme<double>&, double) { return std::make_unique<ZeroPredictor>(); };
  return {.id = kZero, .meaning = "nothing is known", .make = {make, nullptr}};
}

/// Registers both, once in this program.
IntegratorOptions withBoth(double tol) {
  static const bool registered = [] {
    registerStrategy(steady());
    registerStrategy(zero());
    return true;
  }();
  static_cast<void>(registered);
  IntegratorOptions o = adaptive(tol);
  o.step.control = kSteady;
  o.predictor = kZero;
  return o;
}

Solution<double> pendulum(const IntegratorOptions& options) {
  return integrate<double>(CartesianPendulum{}, pendulumStart<double>(), 0.5, makeTableau<double>("radau_iia_3"),
                           options);
}

TEST(Strategies, OnesFromOutsideRunAnIntegration) {
  g_decisions = g_predictions = 0;
  const auto own = pendulum(withBoth(1e-8));
  ASSERT_EQ(own.outcome, Outcome::kSuccess) << own.detail;
  EXPECT_GE(g_decisions, own.counters.steps_accepted);
  EXPECT_GT(g_predictions, own.counters.steps_accepted);
  const auto library = pendulum(adaptive(1e-8));
  EXPECT_LT((own.state.u - library.state.u).norm(), 1e-6);
  EXPECT_NE(own.counters.newton_iterations, library.counters.newton_iterations);
}

/// Sizes that are no steps.
class WrongController final : public StepController {
 public:
  explicit WrongController(double h) : h_(h) {}
  StepDecision decide(double, double) override { return {true, h_}; }
  double afterFailure(double) override { return h_; }
  void forget() override {}
  void changeOrder(int, double, double) override {}

 private:
  double h_;
};

TEST(Strategies, SizesThatAreNoStepsAreNamed) {
  static double h = 0;
  constexpr StepControl kWrong{{"wrong"}};
  registerStrategy(Strategy<StepControl>{kWrong, "no steps", {.estimate = true}, [](const StepOptions&, int) {
                                           return std::make_unique<WrongController>(h);
                                         }});
  IntegratorOptions options = withBoth(1e-8);
  options.step.control = kWrong;
  for (const double size : {std::nan(""), -1.0, 0.0}) {
    h = size;
    const auto solution = pendulum(options);
    EXPECT_NE(solution.outcome, Outcome::kSuccess) << size;
    EXPECT_EQ(solution.counters.steps_accepted, 1) << size;
    EXPECT_EQ(solution.counters.steps_rejected_newton, 0) << size;
    EXPECT_TRUE(contains(solution.detail, "the step control chose no size > 0"));
  }
}

TEST(Strategies, OnesFromOutsideAreFoundByTheirIds) {
  static_cast<void>(withBoth(1e-6));
  EXPECT_EQ(parseId<StepControl>("steady"), kSteady);
  EXPECT_EQ(parseId<Predictor>("zero"), kZero);
  const auto all = named<Predictor>();
  const auto at = std::find_if(all.begin(), all.end(), [](const auto& one) { return one.id == "zero"; });
  ASSERT_NE(at, all.end());
  EXPECT_EQ(at->meaning, "nothing is known");
  EXPECT_EQ(all.front().value, IntegratorOptions().predictor);  // the default stays first
}

TEST(Strategies, ATakenIdIsRefusedNamingBoth) {
  Strategy<Predictor> other = zero();
  other.id = Predictor::kPrevious;
  const std::string why = refusal([&] { registerStrategy(other); });
  for (const char* word : {"predictor 'previous'", "nothing is known", "stages of the step before"}) {
    EXPECT_TRUE(contains(why, word));
  }
  EXPECT_EQ(refusal([] { pendulum(withBoth(1e-4)); }), "");
  const std::string twice = refusal([] { registerStrategy(zero()); });
  EXPECT_TRUE(contains(twice, "taken"));
}

TEST(Strategies, WhatCannotBeUsedIsRefused) {
  const auto why = [](const std::function<void(Strategy<StepControl>&)>& damage) {
    Strategy<StepControl> entry = steady();
    entry.id = {{"steady_too"}};
    damage(entry);
    return refusal([&] { registerStrategy(entry); });
  };
  EXPECT_EQ(why([](auto& entry) { entry.make = nullptr; }), "control 'steady_too': `make` is empty");
  EXPECT_EQ(why([](auto& entry) { entry.id = {{"steady too"}}; }),
            "control 'steady too': an id has small letters, digits and '_'");
  EXPECT_EQ(why([](auto& entry) { entry.id = {{""}}; }), "control '': an id has small letters, digits and '_'");
  EXPECT_EQ(why([](auto& entry) { entry.meaning.clear(); }),
            "control 'steady_too': `meaning` is empty: say in a sentence what it is");
  EXPECT_EQ(refusal([] {
              Strategy<Predictor> entry = zero();
              entry.id = {{"zero_too"}};
              entry.make = {};
              registerStrategy(entry);
            }),
            "predictor 'zero_too': `make` is empty for double");
}

TEST(Strategies, UnknownIdsAreRefusedWithTheNearest) {
  IntegratorOptions o = adaptive(1e-6);
  o.predictor = Predictor{{"previos"}};
  const std::string why = refusal([&] { pendulum(o); });
  EXPECT_TRUE(contains(why, "did you mean 'previous'"));
}

TEST(Strategies, NeedsOfOnesFromOutsideAreRules) {
  IntegratorOptions o = withBoth(1e-6);
  o.step.estimate = ErrorEstimate::kNone;
  const std::string estimate = refusal([&] { pendulum(o); });
  EXPECT_TRUE(contains(estimate, "control 'steady' with estimate 'none'"));
  const std::string scalar = refusal([] {
    Integrator<BigFloat>(makeSystem<BigFloat>(CartesianPendulum{}), makeTableau<BigFloat>("radau_iia_3"),
                         withBoth(1e-6));
  });
  EXPECT_TRUE(contains(scalar, "predictor 'zero' in multiprecision"));
}

}  // namespace
}  // namespace irk::test
