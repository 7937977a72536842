// Inputs and forces that act between the stages of a step.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/support.h"

namespace irk::test {
namespace {

/// x' = -x + 20 while |t - centre| < width / 2, which nobody declares.
struct UndeclaredPulse {
  double centre, width;
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::abs;
    r.x[0] = -p.x[0] + (abs(p.t - centre) < T(width / 2) ? T(20) : T(0)) - p.k[0];
  }
  double at(double t) const {
    return std::exp(-t) + 20 * (std::exp(centre + width / 2 - t) - std::exp(centre - width / 2 - t));
  }
};

// Steps are up to a fifth of the interval, and most pulses lie between their stages.
TEST(Defect, FindsAPulseThatLastsAFiftiethOfTheInterval) {
  int runs = 0, wrong = 0;
  for (const char* method : {"radau_iia_3", "radau_iia_5"}) {
    for (const bool doubles : {false, true}) {
      for (double centre = 0.2; centre < 1.9; centre += 0.017) {
        const UndeclaredPulse pulse{centre, 0.04};
        const auto start = startOf(pulse, {.x = {1}});
        const auto options = doubles ? adaptive(1e-4) : embedded(1e-4);
        const auto s = integrate<double>(pulse, start, 2, makeTableau<double>(method), options);
        ++runs;
        wrong += s.outcome == Outcome::kSuccess && std::abs(s.state.x[0] - pulse.at(2)) > 100e-4;
      }
    }
  }
  EXPECT_EQ(wrong, 0) << "of " << runs;
}

/// The same pulse, which acts only behind a switch at the time 1. y is the time.
struct PulseBehindASwitch {
  UndeclaredPulse pulse;
  Sizes sizes() const { return {.nx = 2, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::abs;
    const bool acts = p.d[0] > T(0.5) && abs(p.t - pulse.centre) < T(pulse.width / 2);
    r.x[0] = -p.x[0] + (acts ? T(20) : T(0)) - p.k[0];
    r.x[1] = T(1) - p.k[1];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.5) ? T(-1) : T(p.x[1] - 1.0);
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T* d) const {
    d[0] = T(1);
  }
};

// The step over the switch has looked behind it, too, but in the mode before.
TEST(Defect, LooksAgainInANewMode) {
  int runs = 0, wrong = 0;
  for (const char* method : {"radau_iia_3", "radau_iia_5"}) {
    for (const bool doubles : {false, true}) {
      for (double centre = 1.03; centre < 1.4; centre += 0.007) {
        const PulseBehindASwitch problem{{centre, 0.04}};
        const auto start = startOf(problem, {.x = {1, 0}});
        const auto options = doubles ? adaptive(1e-4) : embedded(1e-4);
        const auto s = integrate<double>(problem, start, 2, makeTableau<double>(method), options);
        ++runs;
        ASSERT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
        wrong += s.outcome == Outcome::kSuccess && std::abs(s.state.x[0] - problem.pulse.at(2)) > 100e-4;
      }
    }
  }
  EXPECT_EQ(wrong, 0) << "of " << runs;
}

// A pulse of 1 / 250 of the interval is shorter than the steps' own looks are sure to find, and as long as 500 are.
TEST(Defect, FindsShorterPulsesWithMoreLooks) {
  int missed_with_few = 0, missed_with_many = 0;
  for (double centre = 0.2; centre < 1.9; centre += 0.017) {
    const UndeclaredPulse pulse{centre, 0.008};
    const auto start = startOf(pulse, {.x = {1}});
    for (const std::int64_t looks : {10, 500}) {
      IntegratorOptions options = embedded(1e-4);
      options.step.looks = looks;
      const auto s = integrate<double>(pulse, start, 2, makeTableau<double>("radau_iia_5"), options);
      const bool missed = s.outcome == Outcome::kSuccess && std::abs(s.state.x[0] - pulse.at(2)) > 100e-4;
      (looks == 500 ? missed_with_many : missed_with_few) += missed;
    }
  }
  EXPECT_EQ(missed_with_many, 0);
  EXPECT_GT(missed_with_few, 20);
}

/// u'' = force in |u - 1| < width, else 0: the energy gives the speed behind it, or the mass comes back.
struct ShortForce {
  double force, width;
  Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T d = p.u[0] - 1.0;
    r.u[0] = (d > T(-width) && d < T(width) ? T(force) : T(0.0)) - p.a[0];
  }
  State<double> start() const { return startOf(sizes(), {.v = {1}}); }
  double finalSpeed() const {
    const double squared = 1 + 4 * width * force;
    return squared > 0 ? std::sqrt(squared) : -1;
  }
};

// The error at such a point leads out of the range of the force, the farther the stronger the force is.
TEST(Defect, FindsAForceOfShortRangeHoweverStrongItIs) {
  for (const double force : {-0.5, -3.0, -12.0, -60.0, -600.0}) {
    const ShortForce problem{force, 0.02};
    for (const char* method : {"radau_iia_3", "radau_iia_5", "gauss_8"}) {
      for (const IntegratorOptions& options : {embedded(1e-6), adaptive(1e-6)}) {
        const auto s = integrate<double>(problem, problem.start(), 2, makeTableau<double>(method), options);
        ASSERT_EQ(s.outcome, Outcome::kSuccess) << force << ' ' << method << ": " << s.detail;
        EXPECT_NEAR(s.state.v[0], problem.finalSpeed(), 1e-3) << force << ' ' << method;
      }
    }
  }
}

}  // namespace
}  // namespace irk::test
