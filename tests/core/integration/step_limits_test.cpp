#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
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

// Whatever the end is, the last step is no rest.
TEST(Steps, LeaveNoTinyOneToTheEnd) {
  for (const auto estimate : {ErrorEstimate::kRichardson, ErrorEstimate::kEmbedded}) {
    IntegratorOptions o = adaptive(1e-6);
    o.step.estimate = estimate;
    int halved = 0;
    for (double end = 1; end < 1.5; end += 0.01) {
      const auto all = taken(Riccati{}, riccatiStart<double>(), end, o);
      ASSERT_EQ(all.solution.outcome, Outcome::kSuccess);
      ASSERT_GE(all.h.size(), 3U);
      const double last = all.h.back(), before = all.h[all.h.size() - 2];
      EXPECT_GE(last, before * (1 - 1e-9)) << "end " << end;
      halved += std::abs(last - before) < 1e-12;
    }
    EXPECT_GT(halved, 5) << idOf(estimate);
  }
}

// In index 3 a tiny last step has multipliers that are round-off: before, 3 of 1000 runs ended as step_too_small there.
TEST(Steps, EndWellInIndex3) {
  for (int i = 0; i < 300; ++i) {
    const double l = 0.5 + 0.005 * i;
    State<double> start(LongPendulum<double>{l}.sizes());
    LongPendulum<double>::start(start, l);
    const auto system = makeSystem<double>(LongPendulum<double>{l}, {.formulation = Formulation::kIndex3});
    for (const double tol : {1e-4, 1e-6}) {
      Integrator<double> integrator(system, makeTableau<double>("radau_iia_3"), embedded(tol));
      const auto s = integrator.integrate(start, 2);
      EXPECT_EQ(s.outcome, Outcome::kSuccess) << l << " " << tol << " " << s.detail;
    }
  }
}

TEST(Steps, AreNotBelowTheSmallestButAFailure) {
  IntegratorOptions o = adaptive(1e-10);
  const auto free = taken(Riccati{}, riccatiStart<double>(), 2, o);
  ASSERT_EQ(free.solution.outcome, Outcome::kSuccess);
  const double least = *std::min_element(free.h.begin(), free.h.end());
  o.step.h_min = 0.9 * least;
  EXPECT_EQ(taken(Riccati{}, riccatiStart<double>(), 2, o).solution.outcome, Outcome::kSuccess);
  o.step.h_min = 0.3;
  EXPECT_EQ(taken(Riccati{}, riccatiStart<double>(), 2, o).solution.outcome, Outcome::kStepTooSmall);
}

/// z = 0 at t = 0; behind it z^2 + z + 1 = 0, so that no step of any size can be solved.
struct Unsolvable {
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 1, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = 1.0 - p.k[0];
    r.z[0] = p.t > T(0.0) ? T(p.z[0] * p.z[0] + p.z[0] + 1.0) : T(p.z[0]);
  }
};

// 16 eps^2 of the interval is the least size at t = 0: 8e-31 of it. Without it steps shrink to 1e-308.
TEST(Steps, AtTimeZeroEndAtAPartOfTheInterval) {
  for (const double t_end : {1e-3, 1.0, 1e6}) {
    const auto run = taken(Unsolvable{}, State<double>(Unsolvable{}.sizes()), t_end, adaptive(1e-6));
    EXPECT_EQ(run.solution.outcome, Outcome::kStepTooSmall) << run.solution.detail;
    const auto at = run.solution.detail.find(", h = ");
    ASSERT_NE(at, std::string::npos) << run.solution.detail;
    const double h = std::strtod(run.solution.detail.c_str() + at + 6, nullptr);
    EXPECT_LT(h, 16 * std::pow(2.220446049250313e-16, 2) * t_end);
    EXPECT_GT(h, 1e-33 * t_end) << "the first size below it";
  }
}

TEST(Steps, OfVariableOrderAreNeverAboveTheLargest) {
  IntegratorOptions o = variable(1e-7);
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
