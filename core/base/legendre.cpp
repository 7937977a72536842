#include "core/base/legendre.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "irk/multiprecision.h"

namespace irk {
namespace {

// With X = 2x - 1: k p_k = (2k - 1) X p_{k-1} - (k - 1) p_{k-2}, P_k = sqrt(2k + 1) p_k.
template <class Real>
struct Coefficients {
  explicit Coefficients(Index k = 0) {
    using std::sqrt;
    const Real j(static_cast<double>(k));
    normal = sqrt(Real(2) * j + Real(1));
    if (k == 0) return;
    up = (Real(2) * j - Real(1)) / j;
    down = (j - Real(1)) / j;
    xi = Real(1) / (Real(2) * sqrt(Real(4) * j * j - Real(1)));
  }
  Real up{}, down{}, normal{}, xi{};
};

template <class Real>
struct Table {
  static constexpr Index kSize = 32;
  Table() {
    for (Index k = 0; k < kSize; ++k) row[static_cast<std::size_t>(k)] = Coefficients<Real>(k);
  }
  Coefficients<Real> at(Index k) const { return k < kSize ? row[static_cast<std::size_t>(k)] : Coefficients<Real>(k); }
  std::array<Coefficients<Real>, static_cast<std::size_t>(kSize)> row;
};

template <class Real>
const Table<Real>& table() {
  static const Table<Real> kTable;
  return kTable;
}

// The integral of P_k from 0 to x, from the values p of P_{k-1} and P_{k+1} at x. For k = 0, P_0 / 2 takes the place
// of the term with P_{k-1}.
template <class Real>
Real integral(Index k, const Vec<Real>& p) {
  const Real up = table<Real>().at(k + 1).xi * p[k + 1];
  return k == 0 ? Real(p[0] / Real(2) + up) : Real(up - table<Real>().at(k).xi * p[k - 1]);
}

}  // namespace

template <class Real>
void legendre(const Real& x, Eigen::Ref<Vec<Real>> p) {
  const Real X = Real(2) * x - Real(1);
  Real now(1), before(0);
  const Table<Real>& known = table<Real>();
  const Index size = p.size();
  Real* const values = p.data();
  const auto add = [&](Index k, const Coefficients<Real>& c) {
    if (k > 0) {
      const Real next = c.up * X * now - c.down * before;
      before = now;
      now = next;
    }
    values[k] = c.normal * now;
  };
  for (Index k = 0; k < std::min(size, Table<Real>::kSize); ++k) add(k, known.row[static_cast<std::size_t>(k)]);
  for (Index k = Table<Real>::kSize; k < size; ++k) add(k, Coefficients<Real>(k));
}

template <class Real>
void integrateLegendre(const Vec<Real>& p, Vec<Real>& once, Vec<Real>& twice) {
  for (Index k = 0; k < once.size(); ++k) once[k] = integral(k, p);
  for (Index k = 0; k < twice.size(); ++k) twice[k] = integral(k, once);
}

template void legendre<double>(const double&, Eigen::Ref<Vec<double>>);
template void legendre<BigFloat>(const BigFloat&, Eigen::Ref<Vec<BigFloat>>);
template void integrateLegendre<double>(const Vec<double>&, Vec<double>&, Vec<double>&);
template void integrateLegendre<BigFloat>(const Vec<BigFloat>&, Vec<BigFloat>&, Vec<BigFloat>&);

}  // namespace irk
