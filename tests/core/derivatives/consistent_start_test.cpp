// (a, k, z) from (u, v, x).
#include "core/derivatives/consistent_start.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/core/support.h"

namespace irk::test {
namespace {

/// x' = z with an equation for z that depends on x.
enum class Equation { kSquare, kRoot, kNone };
struct Algebraic {
  Equation equation;
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 1, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sqrt;
    r.x[0] = p.z[0] - p.k[0];
    if (equation == Equation::kSquare) r.z[0] = p.z[0] * p.z[0] - p.x[0];
    if (equation == Equation::kRoot) r.z[0] = sqrt(p.x[0]) - p.z[0];
    if (equation == Equation::kNone) r.z[0] = p.x[0] - 1.0;
  }
};

struct Found {
  StartReport report;
  State<double> state;
};
Found start(Equation equation, double x, double z, bool w_required = true) {
  const auto system = makeSystem<double>(Algebraic{equation}, {});
  Found found{{}, State<double>(system->sizes())};
  found.state.x[0] = x;
  found.state.w << z, z;
  found.report = ConsistentStart<double>(*system, DerivativeSource::kAutomatic, w_required).apply(found.state);
  return found;
}

// Newton's method for a square root converges to the root on the side of its start value. With derivatives kept from
// these starts it would not.
TEST(ConsistentStart, KeptDerivativesDoNotLeadToAnotherRoot) {
  for (const double z : {0.01, 0.3, 0.9, 1.0, 30.0}) {
    const auto found = start(Equation::kSquare, 1, z);
    EXPECT_EQ(found.report.outcome, Outcome::kSuccess) << found.report.detail;
    EXPECT_NEAR(found.state.z()[0], 1, 1e-14) << z;
    EXPECT_NEAR(found.state.k()[0], 1, 1e-14) << z;
  }
  EXPECT_NEAR(start(Equation::kSquare, 1, -0.3).state.z()[0], -1, 1e-14);
}

TEST(ConsistentStart, FailuresNameThePlaceAndKeepWhatIsGiven) {
  const auto none = start(Equation::kSquare, -1, 0.7);
  EXPECT_EQ(none.report.outcome, Outcome::kInconsistentStart);
  EXPECT_NE(none.report.detail.find("row 1: Newton does not converge"), std::string::npos) << none.report.detail;
  EXPECT_EQ(none.state.z()[0], 0.7);
  const auto nan = start(Equation::kRoot, -1, 0.7);
  EXPECT_EQ(nan.report.outcome, Outcome::kNotFinite);
  EXPECT_NE(nan.report.detail.find("at the start, t = 0: row 1: residual"), std::string::npos) << nan.report.detail;
  EXPECT_EQ(nan.state.z()[0], 0.7);
}

// An equation without a root, whose residual is small enough for start values. At the end of a run it is no solution.
TEST(ConsistentStart, AtTheEndOnlyWhatConvergesCounts) {
  const auto system = makeSystem<double>(Algebraic{Equation::kSquare}, {});
  State<double> state(system->sizes());
  state.x[0] = -1e-20;
  state.w << 1e-4, 1e-4;
  const Vec<double> given = state.w;
  ConsistentStart<double> start(*system, DerivativeSource::kAutomatic, false);
  EXPECT_NE(start.applyAtEnd(state).find("multipliers of the stages: consistent (a, k, z), t = 0: "),
            std::string::npos);
  EXPECT_EQ(state.w, given);
  EXPECT_EQ(start.apply(state).outcome, Outcome::kSuccess);
}

TEST(ConsistentStart, WhatCannotBeDeterminedIsKeptWhereItMayBe) {
  const auto kept = start(Equation::kNone, 1, 0.7);
  EXPECT_EQ(kept.report.outcome, Outcome::kSuccess) << kept.report.detail;
  EXPECT_EQ(kept.state.z()[0], 0.7);
  EXPECT_EQ(start(Equation::kNone, 2, 0.7, false).report.outcome, Outcome::kSuccess);
  EXPECT_EQ(start(Equation::kNone, 2, 0.7, true).report.outcome, Outcome::kInconsistentStart);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(start(Equation::kNone, nan, 0.7, false).report.outcome, Outcome::kNotFinite);
}

}  // namespace
}  // namespace irk::test
