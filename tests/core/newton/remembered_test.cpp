// A contraction that Newton's method remembers from a phase in which the equations are linear.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/support.h"

namespace irk::test {
namespace {

/// A box on a table that oscillates with 2 cos 5t, driven by friction that rises over the width vs, falls to half and
/// stays: nearly linear while it slides, a steep transition when it turns.
struct StribeckBox {
  double vs;
  Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  T step5(const T& x) const {
    return x * x * x * (10 + x * (6 * x - 15));
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    const T slip = p.v[0] - 2 * cos(5 * p.t);
    const T s = slip > T(0) ? T(slip / vs) : T(-slip / vs);
    const T mu = s >= T(3) ? T(0.5) : s >= T(1) ? T(1 - 0.5 * step5(T((s - 1) / 2))) : T(step5(s));
    r.u[0] = p.a[0] + (slip > T(0) ? mu : T(-mu)) * 9.81;
  }
};

// Right values: two independent integrators with 60-digit Taylor series and event location (see the list of
// faults). One iteration with an increment of 1e6 tolerances was accepted here, and two stages had an acceleration that
// was wrong by 9.81.
TEST(Remembered, AContractionEndsNoIterationAfterALargeIncrement) {
  for (const double tol : {1e-5, 1e-6, 1e-7, 1e-8}) {
    for (const char* method : {"radau_iia_3", "radau_iia_5"}) {
      const auto s = integrate<double>(StribeckBox{1e-2}, State<double>(StribeckBox{1e-2}.sizes()), 2,
                                       makeTableau<double>(method), embedded(tol));
      ASSERT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
      EXPECT_NEAR(s.state.u[0], -0.2710997123700737, 1000 * tol) << method << " tol " << tol;
      EXPECT_NEAR(s.state.v[0], -1.683422118462708, 1000 * tol) << method << " tol " << tol;
    }
  }
}

}  // namespace
}  // namespace irk::test
