// The simplifications (4.4) and (4.8) of the Jacobian save evaluations of M.
#include <gtest/gtest.h>

#include "core/derivatives/differentiator.h"
#include "irk/vanishes.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

constexpr Index kBodies = 6;

/// Bodies in a chain of springs, M = diag(1 + u_i^2), with a counter of the evaluations of M.
struct CountedMass {
  int* evaluations;
  int* of_mass;

  Sizes sizes() const { return {.nu = kBodies}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    ++*evaluations;
    for (Index i = 0; i < kBodies; ++i) {
      r.u[i] = -2.0 * p.u[i] - 0.1 * p.v[i];
      if (i > 0) r.u[i] += p.u[i - 1];
      if (i + 1 < kBodies) r.u[i] += p.u[i + 1];
    }
    if (vanishes(p.a)) return;
    ++*of_mass;
    for (Index i = 0; i < kBodies; ++i) r.u[i] -= (1.0 + p.u[i] * p.u[i]) * p.a[i];
  }
};

struct Counted {
  int evaluations = 0, of_mass = 0;
  Linearization<double> at;
};

Counted differentiated(DerivativeSource source, JacobianTerms terms) {
  Counted counted;
  const auto system = makeSystem<double>(CountedMass{&counted.evaluations, &counted.of_mass});
  Differentiator<double> differentiator(*system, source, terms);
  State<double> s(system->sizes());
  for (Index i = 0; i < kBodies; ++i) s.u[i] = 0.3 + 0.1 * static_cast<double>(i), s.w[i] = 2;
  counted.evaluations = counted.of_mass = 0;
  differentiator.evaluate(Level::kFormulated, pointOf(s), counted.at);
  return counted;
}

// 18 directions: a, v and u of 6 bodies.
TEST(MassDerivatives, AreNotEvaluatedWhereTheyAreLeftOut) {
  for (const auto source : {DerivativeSource::kCentral, DerivativeSource::kForward}) {
    const int sides = source == DerivativeSource::kCentral ? 2 : 1, base = 2 - sides;
    const auto full = differentiated(source, JacobianTerms::kFull);
    EXPECT_EQ(full.evaluations, 18 * sides + base) << idOf(source);
    EXPECT_EQ(full.of_mass, full.evaluations) << idOf(source);
    const auto none = differentiated(source, JacobianTerms::kNoMass);
    EXPECT_EQ(none.evaluations, full.evaluations) << idOf(source);
    EXPECT_EQ(none.of_mass, 6 * sides) << "M itself: along a, at which base there is no M";
    const auto some = differentiated(source, JacobianTerms::kNoMassVxz);
    EXPECT_EQ(some.of_mass, 12 * sides + base) << "along a and u";
  }
  // 8 directions at a time: the first of three evaluations contains all of a.
  EXPECT_EQ(differentiated(DerivativeSource::kAutomatic, JacobianTerms::kFull).of_mass, 3);
  EXPECT_EQ(differentiated(DerivativeSource::kAutomatic, JacobianTerms::kNoMass).of_mass, 1);
  EXPECT_EQ(differentiated(DerivativeSource::kAutomatic, JacobianTerms::kNoMass).evaluations, 3);
}

// M = 1 + u^2 remains in D0; the term d(M a)/du = 2 u a is missing in D2.
TEST(MassDerivatives, LeaveForcesAndMassAsTheyAre) {
  const auto full = differentiated(DerivativeSource::kAutomatic, JacobianTerms::kFull);
  const auto none = differentiated(DerivativeSource::kAutomatic, JacobianTerms::kNoMass);
  EXPECT_EQ(none.at.d0, full.at.d0);
  EXPECT_EQ(none.at.d1, full.at.d1);
  for (Index i = 0; i < kBodies; ++i) {
    const double u = 0.3 + 0.1 * static_cast<double>(i);
    EXPECT_NEAR(none.at.dense0()(i, i), -1 - u * u, 1e-14);
    EXPECT_NEAR(none.at.dense2()(i, i), -2, 1e-14);
    EXPECT_NEAR(full.at.dense2()(i, i), -2 - 4 * u, 1e-14);
  }
}

TEST(Vanishing, NeedsValueAndDerivativesToBeZero) {
  Dual<double> x(0.0);
  EXPECT_TRUE(vanishes(x));
  x.d[3] = 1e-300;
  EXPECT_FALSE(vanishes(x)) << "a derivative";
  EXPECT_FALSE(vanishes(Dual<double>(1e-300))) << "a value";
  Vec<double> numbers = Vec<double>::Zero(3);
  EXPECT_TRUE(vanishes(ConstVec<double>(numbers.data(), 3)));
  numbers[2] = -1;
  EXPECT_FALSE(vanishes(ConstVec<double>(numbers.data(), 3)));
}

}  // namespace
}  // namespace irk::test
