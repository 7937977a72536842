#include "core/scheme.h"

#include <cmath>

#include <Eigen/LU>

#include "core/multiprecision.h"

namespace irk {

// With X = 2x - 1: (k + 1) p_{k+1} = (2k + 1) X p_k - k p_{k-1}, P_k = sqrt(2k + 1) p_k.
template <class Real>
void legendre(const Real& x, Eigen::Ref<Vec<Real>> p) {
  using std::sqrt;
  const Index count = p.size();
  const Real X = Real(2) * x - Real(1);
  for (Index k = 0; k < count; ++k) {
    const Real j = Real(static_cast<double>(k));
    if (k == 0) {
      p[0] = Real(1);
    } else if (k == 1) {
      p[1] = X;
    } else {
      p[k] = ((Real(2) * j - Real(1)) * X * p[k - 1] - (j - Real(1)) * p[k - 2]) / j;
    }
  }
  for (Index k = 0; k < count; ++k) p[k] *= sqrt(Real(static_cast<double>(2 * k + 1)));
}

template <class Real>
Scheme<Real>::Scheme(Tableau<Real> t)
    : tableau(std::move(t)), s(tableau.stages()), A(tableau.A), b(tableau.b), c(tableau.c) {
  A2.noalias() = A * A;
  bA.noalias() = A.transpose() * b;
  A_transposed = A.transpose();
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
