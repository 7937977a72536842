// A result that is negative where an exact solution never is: concentrations and amounts.
#include <gtest/gtest.h>

#include <string>

#include "tests/core/trusted.h"

namespace irk::test {
namespace {

/// x_0' = -1, x_1' = -1, and x_1 is said to be never negative. From (1, 1) it is false after t = 1. The mass, held at
/// u = 0, makes GGL and first-order form have other unknowns than the scene.
struct Emptying {
  Sizes sizes() const { return {.nu = 1, .nx = 2, .nz = 1, .constraints = 1}; }
  bool nonNegative(Index i) const { return i == 1; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.a[0] - p.z[0];
    r.x[0] = -1 - p.k[0];
    r.x[1] = -1 - p.k[1];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = u[0];
  }
};

constexpr double kTol = 1e-4, kScale = 10;        // kScale: of x_1; the others have 1
constexpr double kAllowed = 200 * kTol * kScale;  // 200 tolerances where |x_1| is far below its scale

Solution<double> emptied(double t_end, const IntegratorOptions& options, Formulation form = Formulation::kIndex2) {
  State<double> start(Emptying{}.sizes());
  start.x << 1, 1;
  const auto system = makeSystem<double>(Emptying{}, {form});
  Vec<double> scale = Vec<double>::Ones(system->sizes().components());
  scale[3] = kScale;  // x_1: every form begins with u, v, x_0, x_1
  Integrator<double> integrator(system, makeTableau<double>("radau_iia_3"), options, scale);
  return integrator.integrate(start, t_end);
}

TEST(Bounds, ANegativeResultIsInaccurateWhereItCannotBe) {
  for (const IntegratorOptions& options : {adaptive(kTol), embedded(kTol)}) {
    for (const Formulation form : {Formulation::kIndex2, Formulation::kGgl, Formulation::kFirstOrder}) {
      const Solution<double> below = emptied(1 + 1.2 * kAllowed, options, form);
      EXPECT_EQ(below.outcome, Outcome::kInaccurate);
      EXPECT_NE(below.detail.find("x[1] = -0.24"), std::string::npos) << below.detail;
      EXPECT_NE(below.detail.find("never negative"), std::string::npos) << below.detail;
      const Solution<double> within = emptied(1 + 0.9 * kAllowed, options, form);
      EXPECT_EQ(within.outcome, Outcome::kSuccess) << within.detail;
    }
  }
}

// The paper's successes are reported as they are.
TEST(Bounds, ThePapersEstimateDoesNotLookAtThem) {
  IntegratorOptions options = adaptive(kTol);
  options.step.estimate = ErrorEstimate::kDoubling;
  EXPECT_EQ(emptied(2, options).outcome, Outcome::kSuccess);
}

}  // namespace
}  // namespace irk::test
