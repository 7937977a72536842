// The beam's stiffness K = D D, D = tridiag(1, -2, 1) (m + 1)^2.
#include <gtest/gtest.h>

#include <cmath>

#include "irk/multiprecision.h"
#include "irk/scene.h"

namespace irk::test {
namespace {

constexpr double kEps = 2.220446049250313e-16;

State<double> bent(const Scene<double>& scene) {
  State<double> s = scene.start;
  const Index m = s.u.size();
  for (Index i = 0; i < m; ++i) {
    const double x = M_PI * static_cast<double>(i + 1) / static_cast<double>(m + 1);
    s.u[i] = std::sin(x) + 0.2 * std::sin(2 * x);
    s.v[i] = 10 * std::sin(3 * x);
  }
  s.w.setZero();
  return s;
}

// The product D D y row by row, with zeros beyond the ends and negligible round-off.
Vec<BigFloat> secondDifferences(const Vec<BigFloat>& y) {
  const Index m = y.size();
  Vec<BigFloat> D = -2 * y;
  D.head(m - 1) += y.tail(m - 1);
  D.tail(m - 1) += y.head(m - 1);
  return D;
}

// The round-off of the residual is that of differences of neighbours, which shrink with the mesh: no digits of u and
// v are lost. Terms of the size of u itself would give eps (m + 1)^4.
TEST(BeamChain, StiffnessLosesNoDigitsOnAFineMesh) {
  const Scene<double> scene = makeScene<double>("beam_chain", {{"m", "2000"}});
  const State<double> s = bent(scene);
  const auto system = scene.system({});
  Vec<double> r(system->sizes().n());
  system->evaluate(Level::kFormulated, pointOf(s), {r.data(), r.size()});

  const Index m = s.u.size();
  const double n4 = std::pow(static_cast<double>(m + 1), 4);
  const BigFloat damping = BigFloat(1) / 1000;
  const Vec<BigFloat> q = s.u.cast<BigFloat>() + damping * s.v.cast<BigFloat>();
  const Vec<BigFloat> Kq = BigFloat(n4) * secondDifferences(secondDifferences(q));
  const double neighbours = (s.u.tail(m - 1) - s.u.head(m - 1)).cwiseAbs().maxCoeff() +
                            0.001 * (s.v.tail(m - 1) - s.v.head(m - 1)).cwiseAbs().maxCoeff();
  // Four differences and three sums, each with half an eps of its terms; at t = 0 there is no force.
  const double bound = 8 * kEps * n4 * neighbours;
  double error = 0;
  for (Index i = 0; i < m; ++i) {
    error = std::max(error, std::abs(static_cast<double>(BigFloat(BigFloat(r[i]) + Kq[i]))));
  }
  EXPECT_LE(error, bound);
  EXPECT_GT(bound, 0);
  EXPECT_LT(bound, kEps * n4 / 10) << "a fourth difference at once would pass";
}

// Checks all entries, including the ends: column j is the residual for u_j = 1.
TEST(BeamChain, StiffnessIsTheSquareOfD) {
  const Index m = 6;
  const auto scene = makeScene<double>("beam_chain", {{"m", "6"}});
  const auto system = scene.system({});
  Mat<double> D = Mat<double>::Zero(m, m);
  D.diagonal().setConstant(-2);
  D.diagonal(1).setOnes();
  D.diagonal(-1).setOnes();
  D *= 49;
  const Mat<double> K = D * D;
  for (Index j = 0; j < m; ++j) {
    State<double> s(system->sizes());
    s.u[j] = 1;
    Vec<double> r(m);
    system->evaluate(Level::kFormulated, pointOf(s), {r.data(), r.size()});
    EXPECT_LE((r + K.col(j)).cwiseAbs().maxCoeff(), 8 * kEps * K.cwiseAbs().maxCoeff()) << j;
  }
}

}  // namespace
}  // namespace irk::test
