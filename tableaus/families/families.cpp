#include "tableaus/families/families.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/text.h"
#include "irk/misuse.h"
#include "tableaus/families/nodes.h"

namespace irk {
namespace {

// A coefficient below this bound, in units of round-off, is zero. The construction's error is at most 1e8 (s = 100);
// all coefficients that are not zero are far larger.
constexpr double kZeroThreshold = 1e15;

bool hasLeftEnd(Quadrature quadrature) {
  return quadrature == Quadrature::kRadauLeft || quadrature == Quadrature::kLobatto;
}

bool hasRightEnd(Quadrature quadrature) {
  return quadrature == Quadrature::kRadauRight || quadrature == Quadrature::kLobatto;
}

// If an end is a node, its factor belongs to the weight function of the polynomial whose zeros are the other nodes.
Vec<BigFloat> quadratureNodes(Quadrature quadrature, Index s) {
  const int left = hasLeftEnd(quadrature) ? 1 : 0;
  const int right = hasRightEnd(quadrature) ? 1 : 0;
  Vec<BigFloat> c(s);
  if (left == 1) c[0] = 0;
  if (right == 1) c[s - 1] = 1;
  c.segment(left, s - left - right) = jacobiZeros(s - left - right, right, left);
  return c;
}

/// W_ik = P_k(c_i), orthonormal on [0, 1], k = 0 .. s-1.
Mat<BigFloat> legendreBasis(const Vec<BigFloat>& c) {
  const Index s = c.size();
  Mat<BigFloat> W(s, s);
  for (Index i = 0; i < s; ++i) {
    const BigFloat x = 2 * c[i] - 1;
    BigFloat L = 1, L_before = 0;
    for (Index k = 0; k < s; ++k) {
      W(i, k) = sqrt(BigFloat(2 * k + 1)) * L;
      const BigFloat L_next = ((2 * k + 1) * x * L - k * L_before) / (k + 1);
      L_before = L;
      L = L_next;
    }
  }
  return W;
}

/// d_s: 1 unless the quadrature is too weak to integrate P_{s-1}^2 exactly.
BigFloat lastNorm(Quadrature quadrature, Index s) {
  return quadrature == Quadrature::kLobatto ? 2 + BigFloat(1) / (s - 1) : BigFloat(1);
}

BigFloat cornerSize(Quadrature quadrature, Index s) {
  return BigFloat(1) / (quadrature == Quadrature::kLobatto ? 2 * (s - 1) : 4 * s - 2);
}

/// X of HW II, IV.5: integration in the basis W; the last row and column depend on the family.
Mat<BigFloat> integrationMatrix(const Family& family, Index s) {
  Mat<BigFloat> X = Mat<BigFloat>::Zero(s, s);
  X(0, 0) = BigFloat(1) / 2;
  for (Index k = 1; k < s; ++k) {
    const BigFloat xi = 1 / (2 * sqrt(BigFloat(4 * k * k - 1)));
    const bool last = k == s - 1;
    X(k, k - 1) = last ? family.below * xi : xi;
    X(k - 1, k) = last ? -family.above * xi * lastNorm(family.quadrature, s) : BigFloat(-xi);
  }
  if (family.corner != 0) X(s - 1, s - 1) += family.corner * cornerSize(family.quadrature, s);
  return X;
}

}  // namespace

SimplifyingOrders Family::orders(Index s) const {
  const int stages = static_cast<int>(s);
  return {2 * stages - p_gap, stages - q_gap, stages - r_gap};
}

const std::vector<Family>& families() {
  using enum Quadrature;
  static const std::vector<Family> all = {
      {"gauss", "Gauss", kGauss, 0, 0, 0, 1, 1, 0},
      {"radau_ia", "Radau IA", kRadauLeft, 1, 1, 0, 1, 1, 1},
      {"radau_iia", "Radau IIA", kRadauRight, 1, 0, 1, 1, 1, 1},
      {"lobatto_iiia", "Lobatto IIIA", kLobatto, 2, 0, 2, 0, 1, 0},
      {"lobatto_iiib", "Lobatto IIIB", kLobatto, 2, 2, 0, 1, 0, 0},
      {"lobatto_iiic", "Lobatto IIIC", kLobatto, 2, 1, 1, 1, 1, 1},
      {"lobatto_iiics", "Lobatto IIIC*", kLobatto, 2, 1, 1, 1, 1, -1},
      {"lobatto_iiid", "Lobatto IIID", kLobatto, 2, 1, 1, 1, 1, 0},
  };
  return all;
}

const Family* findFamily(std::string_view id) {
  const auto found = std::ranges::find(families(), id, &Family::id);
  return found == families().end() ? nullptr : &*found;
}

const Family& familyOf(std::string_view id) { return entryNamed("tableau family", id, families(), &Family::id); }

void requireStages(const Family& family, Index s) {
  if (s >= family.minStages() && s <= kMaxStages) return;
  throw Misuse(fmt::format("tableau '{0}_{1}': {1} stages, but {0} has {2} to {3}", family.id, s, family.minStages(),
                           kMaxStages));
}

Tableau<BigFloat> constructFamily(const Family& family, Index s) {
  requireStages(family, s);
  const WorkingDigits digits(WorkingDigits::now() + kSpareDigits);
  const Vec<BigFloat> c = quadratureNodes(family.quadrature, s);
  const Mat<BigFloat> W = legendreBasis(c);
  Vec<BigFloat> d = Vec<BigFloat>::Ones(s);
  d[s - 1] = lastNorm(family.quadrature, s);

  // W^T diag(b) W = D, hence diag(b)^-1 = W D^-1 W^T.
  const Mat<BigFloat> W_scaled = W * d.cwiseInverse().asDiagonal();
  const Vec<BigFloat> b = W_scaled.cwiseProduct(W).rowwise().sum().cwiseInverse();

  const Mat<BigFloat> X = integrationMatrix(family, s);
  const Mat<BigFloat> WX = W * X;
  Mat<BigFloat> A = WX * W_scaled.transpose() * b.asDiagonal();
  const BigFloat zero = kZeroThreshold * Eigen::NumTraits<BigFloat>::epsilon();
  A = A.unaryExpr([&zero](const BigFloat& a) { return abs(a) < zero ? BigFloat(0) : a; }).eval();

  const SimplifyingOrders orders = family.orders(s);
  return {fmt::format("{}_{}", family.id, s), family.id, A, b, c, orders.p, orders.q};
}

}  // namespace irk
