#include "tableaus/families.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/misuse.h"
#include "core/text.h"
#include "tableaus/catalogue.h"
#include "tableaus/nodes.h"

namespace irk {
namespace {

// Far above the construction's round-off (1e-72 at s = 100), far below any coefficient of a scheme.
constexpr double kZeroThreshold = 1e-65;

bool hasLeftEnd(Quadrature quadrature) {
  return quadrature == Quadrature::kRadauLeft || quadrature == Quadrature::kLobatto;
}

bool hasRightEnd(Quadrature quadrature) {
  return quadrature == Quadrature::kRadauRight || quadrature == Quadrature::kLobatto;
}

// An end that is a node puts its factor into the weight of the other nodes' polynomial.
Vec<mp80> quadratureNodes(Quadrature quadrature, Index s) {
  const int left = hasLeftEnd(quadrature) ? 1 : 0;
  const int right = hasRightEnd(quadrature) ? 1 : 0;
  Vec<mp80> c(s);
  if (left == 1) c[0] = 0;
  if (right == 1) c[s - 1] = 1;
  c.segment(left, s - left - right) = jacobiZeros(s - left - right, right, left);
  return c;
}

/// W_ik = P_k(c_i), orthonormal on [0, 1], k = 0 .. s-1.
Mat<mp80> legendreBasis(const Vec<mp80>& c) {
  const Index s = c.size();
  Mat<mp80> W(s, s);
  for (Index i = 0; i < s; ++i) {
    const mp80 x = 2 * c[i] - 1;
    mp80 L = 1, L_before = 0;
    for (Index k = 0; k < s; ++k) {
      W(i, k) = sqrt(mp80(2 * k + 1)) * L;
      const mp80 L_next = ((2 * k + 1) * x * L - k * L_before) / (k + 1);
      L_before = L;
      L = L_next;
    }
  }
  return W;
}

/// d_s: 1 unless the quadrature is too weak to integrate P_{s-1}^2 exactly.
mp80 lastNorm(Quadrature quadrature, Index s) {
  return quadrature == Quadrature::kLobatto ? 2 + mp80(1) / (s - 1) : mp80(1);
}

mp80 cornerSize(Quadrature quadrature, Index s) {
  return mp80(1) / (quadrature == Quadrature::kLobatto ? 2 * (s - 1) : 4 * s - 2);
}

/// X of Hairer & Wanner II, IV.5: integration in the basis W, last row and column by family.
Mat<mp80> integrationMatrix(const Family& family, Index s) {
  Mat<mp80> X = Mat<mp80>::Zero(s, s);
  X(0, 0) = mp80(1) / 2;
  for (Index k = 1; k < s; ++k) {
    const mp80 xi = 1 / (2 * sqrt(mp80(4 * k * k - 1)));
    const bool last = k == s - 1;
    X(k, k - 1) = last ? family.below * xi : xi;
    X(k - 1, k) = last ? -family.above * xi * lastNorm(family.quadrature, s) : mp80(-xi);
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

const Family& familyOf(std::string_view id) {
  if (const Family* family = findFamily(id)) return *family;
  std::vector<std::string> known;
  for (const Family& family : families()) known.push_back(family.id);
  throw Misuse(unknownName("tableau family", id, known));
}

Tableau<mp80> constructFamily(const Family& family, Index s) {
  if (s < family.minStages() || s > kMaxStages) {
    throw Misuse(fmt::format("tableau '{0}_{1}': {1} stages, but {0} has {2} to {3}", family.id, s,
                             family.minStages(), kMaxStages));
  }
  const Vec<mp80> c = quadratureNodes(family.quadrature, s);
  const Mat<mp80> W = legendreBasis(c);
  Vec<mp80> d = Vec<mp80>::Ones(s);
  d[s - 1] = lastNorm(family.quadrature, s);

  // W^T diag(b) W = D, hence diag(b)^-1 = W D^-1 W^T.
  const Mat<mp80> W_scaled = W * d.cwiseInverse().asDiagonal();
  const Vec<mp80> b = W_scaled.cwiseProduct(W).rowwise().sum().cwiseInverse();

  const Mat<mp80> X = integrationMatrix(family, s);
  const Mat<mp80> WX = W * X;
  Mat<mp80> A = WX * W_scaled.transpose() * b.asDiagonal();
  A = A.unaryExpr([](const mp80& a) { return abs(a) < kZeroThreshold ? mp80(0) : a; }).eval();

  const SimplifyingOrders orders = family.orders(s);
  return {fmt::format("{}_{}", family.id, s), family.id, A, b, c, orders.p, orders.q};
}

}  // namespace irk
