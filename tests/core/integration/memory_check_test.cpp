// A residual that remembers is no function of its arguments, and is refused before the first step.
#include "core/integration/memory_check.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "irk/multiprecision.h"
#include "tests/core/support.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

/// x' = -x(t - delay), with the history kept in the problem.
struct DelayByHand {
  double delay;
  mutable std::vector<std::pair<double, double>> past{};
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    double old = 1;
    if constexpr (std::is_same_v<T, double>) {
      past.emplace_back(p.t, p.x[0]);
      for (const auto& [t, x] : past) {
        if (t <= p.t - delay) old = x;
      }
    }
    r.x[0] = T(-old) - p.k[0];
  }
};
/// Noise of a relative size, as of sums in another order or of an inner iteration.
struct Noisy {
  double noise;
  mutable std::minstd_rand random{1};
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const double part = static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max());
    r.x[0] = -p.x[0] * (1.0 + noise * part) - p.k[0];
  }
};

template <class P>
std::string refusalOfRun(const P& problem, double t_end, Formulation formulation = Formulation::kIndex2) {
  const auto start = startOf(problem, {.x = {1}});
  return refusal([&] {
    (void)integrate<double>(problem, start, t_end, makeTableau<double>("radau_iia_3"), adaptive(1e-4), formulation);
  });
}

TEST(MemoryCheck, AHistoryInTheProblemIsRefused) {
  for (const double delay : {0.1, 1.0, 2.0}) {
    for (const Formulation formulation : {Formulation::kIndex2, Formulation::kFirstOrder}) {
      const std::string message = refusalOfRun(DelayByHand{delay}, 5, formulation);
      EXPECT_TRUE(contains(message, "row 0 of the residual")) << delay;
      EXPECT_TRUE(contains(message, "keeps no history")) << delay;
    }
  }
}

TEST(MemoryCheck, NoiseIsRefusedAboveEightDigitsOnly) {
  EXPECT_NE(refusalOfRun(Noisy{1e-3}, 1), "");
  EXPECT_EQ(refusalOfRun(Noisy{1e-12}, 1), "");
  EXPECT_EQ(refusalOfRun(Noisy{0}, 1), "");
}

// Not finite for x > 1: where a residual is not defined, nothing is compared.
TEST(MemoryCheck, PointsOutsideOfTheDomainAreNotJudged) {
  const FirstOrder problem{[](const auto& p) {
    using std::sqrt;
    return -sqrt(1.0 - p.x[0]) - 1.0;
  }};
  EXPECT_EQ(refusalOfRun(problem, 0.5), "");
  const auto start = startOf(problem, {.x = {1}});
  EXPECT_NO_THROW(requireNoMemory(*makeSystem<double>(problem, {}), start, 0.5));
}

}  // namespace
}  // namespace irk::test
