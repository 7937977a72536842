// A start at which derivatives are 0/0 although the residual is finite: the row, the component, and what helps.
#include "core/derivatives/derivative_fault.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/core/support.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

/// A mass in the plane with quadratic drag |w| w of the wind relative to it, and a third coordinate without drag.
struct Drag {
  double wind = 0;
  Sizes sizes() const { return {.nu = 3}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sqrt;
    const T x = wind - p.v[1], y = -p.v[2], w = sqrt(x * x + y * y);
    r.u[0] = -p.a[0] - p.u[0];
    r.u[1] = -p.a[1] + w * x;
    r.u[2] = -p.a[2] + w * y;
  }
};

Solution<double> fly(double wind, DerivativeSource source) {
  State<double> start(Drag{}.sizes());
  IntegratorOptions options = adaptive(1e-6);
  options.derivatives = source;
  return integrate<double>(Drag{wind}, start, 1, makeTableau<double>("radau_iia_5"), options);
}

TEST(DerivativeFault, NamesRowComponentAndWhatMayPass) {
  const Solution<double> s = fly(0, DerivativeSource::kAutomatic);
  EXPECT_EQ(s.outcome, Outcome::kNotFinite);
  for (const char* part : {"at the start, t = 0: row 1: dr/d(a, k, z) is not finite, though r is",
                           "it is finite beside v[1] = 0", "0/0", "'difference_central'"}) {
    EXPECT_TRUE(contains(s.detail, part));
  }
}

// With differences the mass stays at rest, which is the exact solution; with wind there is no fault.
TEST(DerivativeFault, DifferencesPassAsTheMessageSays) {
  const Solution<double> s = fly(0, DerivativeSource::kCentral);
  ASSERT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
  EXPECT_EQ(s.state.u.norm() + s.state.v.norm(), 0);
  // v' = (wind - v)^2 from 0: v = wind - 1 / (t + 1 / wind).
  const Solution<double> windy = fly(2, DerivativeSource::kAutomatic);
  ASSERT_EQ(windy.outcome, Outcome::kSuccess) << windy.detail;
  EXPECT_NEAR(windy.state.v[1], 2 - 1 / 1.5, 1e-5);
}

/// BothAtZero components have to move: sqrt(x_0^2 x_1^2) at (0, 0).
struct BothAtZero {
  Sizes sizes() const { return {.nx = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sqrt;
    r.x[0] = -p.k[0] - sqrt(p.x[0] * p.x[0] * p.x[1] * p.x[1]);
    r.x[1] = -p.k[1];
  }
};
TEST(DerivativeFault, NamesNoComponentWhereNoSingleOneHelps) {
  const auto system = makeSystem<double>(BothAtZero{}, {});
  const State<double> state(BothAtZero{}.sizes());
  const std::string text = derivativeFault(*system, DerivativeSource::kAutomatic, state);
  EXPECT_TRUE(contains(text, "row 0"));
  EXPECT_EQ(text.find("beside"), std::string::npos) << text;
}

}  // namespace
}  // namespace irk::test
