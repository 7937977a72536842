#include "core/scheme.h"

#include <array>
#include <cmath>

#include <Eigen/LU>

#include "core/multiprecision.h"

namespace irk {

namespace {

// With X = 2x - 1: k p_k = (2k - 1) X p_{k-1} - (k - 1) p_{k-2}, P_k = sqrt(2k + 1) p_k.
template <class Real>
struct LegendreCoefficients {
  explicit LegendreCoefficients(Index k = 0) {
    using std::sqrt;
    const Real j(static_cast<double>(k));
    normal = sqrt(Real(2) * j + Real(1));
    if (k == 0) return;
    up = (Real(2) * j - Real(1)) / j;
    down = (j - Real(1)) / j;
  }
  Real up{}, down{}, normal{};
};

template <class Real>
struct LegendreTable {
  static constexpr Index kSize = 32;
  LegendreTable() {
    for (Index k = 0; k < kSize; ++k) {
      row[static_cast<std::size_t>(k)] = LegendreCoefficients<Real>(k);
    }
  }
  LegendreCoefficients<Real> at(Index k) const {
    return k < kSize ? row[static_cast<std::size_t>(k)] : LegendreCoefficients<Real>(k);
  }
  std::array<LegendreCoefficients<Real>, static_cast<std::size_t>(kSize)> row;
};

}  // namespace

template <class Real>
void legendre(const Real& x, Eigen::Ref<Vec<Real>> p) {
  static const LegendreTable<Real> table;
  const Real X = Real(2) * x - Real(1);
  Real now(1), before(0);
  for (Index k = 0; k < p.size(); ++k) {
    const LegendreCoefficients<Real> c = table.at(k);
    if (k > 0) {
      const Real next = c.up * X * now - c.down * before;
      before = now;
      now = next;
    }
    p[k] = c.normal * now;
  }
}

template <class Real>
Scheme<Real>::Scheme(Tableau<Real> t)
    : tableau(std::move(t)), s(tableau.stages()), A(tableau.A), b(tableau.b), c(tableau.c) {
  A2.noalias() = A * A;
  bA.noalias() = A.transpose() * b;
  A_transposed = A.transpose();
  A1 = A.rowwise().sum();
  A2_transposed = A2.transpose();
  // Round-off of a sum of s coefficients of size <= 1.
  const Real tiny = Real(10.0 * static_cast<double>(s)) * Eigen::NumTraits<Real>::epsilon();
  const auto small = [&](const auto& x) { return x.cwiseAbs().maxCoeff() <= tiny; };
  stiffly_accurate = small(A.row(s - 1).transpose() - b);
  first = s > 1 && stiffly_accurate && small(A.row(0)) ? 1 : 0;
  const Eigen::FullPivLU<Mat<Real>> lu(implicitA());
  regular = lu.isInvertible();
  if (regular && first == 0) d = Mat<Real>(A.transpose()).fullPivLu().solve(b);

  Mat<Real> V(s, s);  // transposed: column i = stage i
  for (Index i = 0; i < s; ++i) legendre<Real>(c[i], V.col(i));
  legendre_inverse = V.transpose().fullPivLu().inverse();
  legendre_inverse_transposed = legendre_inverse.transpose();
  Vec<Real> at(s);
  legendre<Real>(Real(1), at);
  end = legendre_inverse.transpose() * at;
  legendre<Real>(Real(0), at);
  start = legendre_inverse.transpose() * at;
}

template struct Scheme<double>;
template struct Scheme<mp50>;
template struct Scheme<mp100>;
template void legendre<double>(const double&, Eigen::Ref<Vec<double>>);
template void legendre<mp50>(const mp50&, Eigen::Ref<Vec<mp50>>);
template void legendre<mp100>(const mp100&, Eigen::Ref<Vec<mp100>>);

}  // namespace irk
