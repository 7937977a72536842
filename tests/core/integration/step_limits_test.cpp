#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>
#include <vector>

#include "core/control/controller.h"
#include "core/derivatives/differentiator.h"
#include "core/estimates/step_attempt.h"
#include "core/stages/error_norm.h"
#include "tests/core/support.h"
#include "tests/core/watched.h"

namespace irk::test {
namespace {

TEST(Steps, AreNeverAboveTheLargest) {
  for (const auto control : {StepControl::kPredictive, StepControl::kPaper, StepControl::kHotint}) {
    for (const auto estimate : {ErrorEstimate::kRichardson, ErrorEstimate::kEmbedded}) {
      IntegratorOptions o = adaptive(1e-3);
      o.step.control = control;
      o.step.estimate = estimate;
      const auto free = taken(Riccati{}, riccatiStart<double>(), 4, o);
      ASSERT_GT(*std::max_element(free.h.begin(), free.h.end()), 0.2);
      for (const double first : {0.0, 3.0}) {
        o.step.h_max = 0.0625;
        o.step.h = first;
        const auto all = taken(Riccati{}, riccatiStart<double>(), 4, o);
        ASSERT_EQ(all.solution.outcome, Outcome::kSuccess);
        const double largest = *std::max_element(all.h.begin(), all.h.end());
        EXPECT_LE(largest, 0.0625 * (1 + 1e-9)) << idOf(control) << " " << idOf(estimate);
        EXPECT_GE(largest, 0.0625 * (1 - 1e-9)) << "and reach it";
        EXPECT_GE(all.h.size(), 64u);
      }
    }
  }
}

TEST(Steps, AreNotBelowTheSmallestButAFailure) {
  IntegratorOptions o = adaptive(1e-10);
  o.step.control = StepControl::kPredictive;
  o.step.estimate = ErrorEstimate::kRichardson;
  const auto free = taken(Riccati{}, riccatiStart<double>(), 2, o);
  ASSERT_EQ(free.solution.outcome, Outcome::kSuccess);
  const double least = *std::min_element(free.h.begin(), free.h.end());
  o.step.h_min = 0.9 * least;
  EXPECT_EQ(taken(Riccati{}, riccatiStart<double>(), 2, o).solution.outcome, Outcome::kSuccess);
  o.step.h_min = 0.3;
  EXPECT_EQ(taken(Riccati{}, riccatiStart<double>(), 2, o).solution.outcome, Outcome::kStepTooSmall);
}

TEST(Steps, OfVariableOrderAreNeverAboveTheLargest) {
  IntegratorOptions o = adaptive(1e-7);
  o.step.control = StepControl::kPredictive;
  o.step.estimate = ErrorEstimate::kEmbedded;
  o.order = OrderControl::kVariable;
  for (const double largest : {0.3, 0.1, 0.05}) {
    o.step.h_max = largest;
    Integrator<double> integrator(makeSystem<double>(Riccati{}), makeMethods<double>("radau_iia_3", 13, 5), o);
    double most = 0;
    Monitor<double> monitor;
    monitor.accepted = [&](const StepRecord<double>& s) { most = std::max(most, s.h); };
    ASSERT_EQ(integrator.integrate(riccatiStart<double>(), 20, monitor).outcome, Outcome::kSuccess);
    EXPECT_LE(most, largest * (1 + 1e-9));
    EXPECT_GE(most, 0.5 * largest);
  }
}

TEST(Steps, AttemptsAreCountedAgainstTheirLimit) {
  IntegratorOptions o = adaptive(1e-7);
  o.step.control = StepControl::kPredictive;
  o.step.estimate = ErrorEstimate::kRichardson;
  const Counters c = taken(Riccati{}, riccatiStart<double>(), 4, o).solution.counters;
  o.step.max_steps = c.steps_accepted + c.steps_rejected_error + c.steps_rejected_newton;
  EXPECT_EQ(taken(Riccati{}, riccatiStart<double>(), 4, o).solution.outcome, Outcome::kSuccess);
  --o.step.max_steps;
  EXPECT_EQ(taken(Riccati{}, riccatiStart<double>(), 4, o).solution.outcome, Outcome::kMaxSteps);
}

TEST(Steps, AcceptedOnesHaveErrorsWithinTheTolerance) {
  for (const auto control : {StepControl::kPredictive, StepControl::kPaper, StepControl::kHotint}) {
    IntegratorOptions o = adaptive(1e-6);
    o.step.control = control;
    o.step.estimate = ErrorEstimate::kRichardson;
    o.step.h = 1;  // too large: rejected
    const auto all = taken(Riccati{}, riccatiStart<double>(), 4, o);
    ASSERT_EQ(all.solution.outcome, Outcome::kSuccess);
    EXPECT_GE(all.solution.counters.steps_rejected_error, 1);
    EXPECT_EQ(all.solution.counters.steps_accepted, static_cast<std::int64_t>(all.h.size()));
    double sum = 0;
    for (std::size_t i = 0; i < all.h.size(); ++i) {
      EXPECT_LE(all.error[i], 1);
      sum += all.h[i];
    }
    EXPECT_NEAR(sum, 4, 1e-12);
  }
}

}  // namespace
}  // namespace irk::test
