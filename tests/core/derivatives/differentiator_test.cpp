// D0, D1, D2: automatic differentiation against differences, also for more directions than one chunk.
#include <gtest/gtest.h>

#include "core/derivatives/differentiator.h"
#include "irk/multiprecision.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

/// A chain of nu nonlinear oscillators with nx filters and a coupled mass: no block of D0, D1, D2 is zero.
struct Chain {
  Index nu, nx;
  Sizes sizes() const { return {.nu = nu, .nx = nx, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    for (Index i = 0; i < nu; ++i) {
      const Index j = (i + 1) % nu;
      r.u[i] = sin(p.u[i] - p.u[j]) - p.v[i] * p.v[j] + p.x[i % nx] * p.u[i] - (2.0 + p.u[j] * p.v[i]) * p.a[i];
    }
    for (Index i = 0; i < nx; ++i) r.x[i] = p.u[i % nu] * p.v[i % nu] - p.x[i] * p.x[i] - p.k[i];
  }
};

template <class Real>
void linearize(const System<Real>& system, Differentiator<Real>& differentiator, Linearization<Real>& D) {
  const Sizes n = system.sizes();
  const auto wave = [](Index size, double phase) {
    return Vec<Real>(Vec<double>::NullaryExpr(size, [=](Index i) {
                       return std::sin(0.7 * static_cast<double>(i) + phase);
                     }).template cast<Real>());
  };
  const Vec<Real> u = wave(n.nu, 0.1), v = wave(n.nu, 0.4), x = wave(n.nx, 0.9);
  const Vec<Real> w = wave(n.n(), 1.3);
  const Point<Real> p{Real(0.3),
                      {u.data(), n.nu},
                      {v.data(), n.nu},
                      {x.data(), n.nx},
                      {w.data(), n.nu},
                      {w.data() + n.nu, n.nx},
                      {w.data() + n.nu + n.nx, n.nz}};
  differentiator.evaluate(Level::kFormulated, p, D);
}

template <class Real>
Linearization<Real> linearize(const System<Real>& system, DerivativeSource source) {
  Linearization<Real> D(Pattern::dense(system.sizes().n()));
  Differentiator<Real> differentiator(system, source);
  linearize(system, differentiator, D);
  return D;
}

void expectNear(const Linearization<double>& a, const Linearization<double>& b, double tolerance) {
  EXPECT_LE((a.d0 - b.d0).lpNorm<Eigen::Infinity>(), tolerance);
  EXPECT_LE((a.d1 - b.d1).lpNorm<Eigen::Infinity>(), tolerance);
  EXPECT_LE((a.d2 - b.d2).lpNorm<Eigen::Infinity>(), tolerance);
  EXPECT_GT(a.d0.norm() + a.d1.norm(), 0.1);
}

// In turn, as the Jacobian of the steps and that of consistent starts are; D0 alone leaves other directions untouched.
TEST(Linearization, IsTheSameWithSharedScratch) {
  const auto system = makeSystem<double>(Chain{16, 4});
  const State<double> other(system->sizes());
  for (const auto source : {DerivativeSource::kAutomatic, DerivativeSource::kForward, DerivativeSource::kCentral}) {
    const auto own = linearize(*system, source);
    Differentiator<double> all(*system, source, JacobianTerms::kFull, Storage::kDense);
    Differentiator<double> rates(*system, source, JacobianTerms::kFull, Storage::kDense, Matrices::kOnlyD0,
                                 all.scratch());
    EXPECT_EQ(rates.scratch(), all.scratch());
    Linearization<double> D(Pattern::dense(system->sizes().n())), D0 = D;
    rates.evaluate(Level::kFormulated, pointOf(other), D0);
    linearize(*system, all, D);
    rates.evaluate(Level::kFormulated, pointOf(other), D0);
    linearize(*system, all, D);
    EXPECT_EQ(D.d0, own.d0);
    EXPECT_EQ(D.d1, own.d1);
    EXPECT_EQ(D.d2, own.d2);
    linearize(*system, rates, D0);
    EXPECT_EQ(D0.d0, own.d0);
  }
}

TEST(Linearization, SourcesAgreeAtTwoHundredUnknowns) {
  const auto system = makeSystem<double>(Chain{160, 40});
  const auto automatic = linearize(*system, DerivativeSource::kAutomatic);
  // Errors are eps^(2/3) and eps^(1/2) times second and third derivatives of order one.
  expectNear(automatic, linearize(*system, DerivativeSource::kCentral), 1e-9);
  expectNear(automatic, linearize(*system, DerivativeSource::kForward), 1e-6);
}

TEST(Linearization, AutomaticIsExactToRoundOff) {
  const auto coarse = linearize(*makeSystem<double>(Chain{5, 3}), DerivativeSource::kAutomatic);
  const auto fine = linearize(*makeSystem<BigFloat>(Chain{5, 3}), DerivativeSource::kCentral);
  for (Index i = 0; i < coarse.d0.size(); ++i) {
    EXPECT_NEAR(coarse.d0[i], static_cast<double>(fine.d0[i]), 1e-14);
    EXPECT_NEAR(coarse.d1[i], static_cast<double>(fine.d1[i]), 1e-14);
    EXPECT_NEAR(coarse.d2[i], static_cast<double>(fine.d2[i]), 1e-14);
  }
}

TEST(Linearization, ConstraintRowsAreTheDerivativesOfTheirLevel) {
  for (const auto& formulation : named<Formulation>()) {
    const auto system = makeSystem<double>(CartesianPendulum{}, {formulation.value});
    expectNear(linearize(*system, DerivativeSource::kAutomatic), linearize(*system, DerivativeSource::kCentral), 1e-9);
  }
}

}  // namespace
}  // namespace irk::test
