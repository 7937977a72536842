#include "core/integration/growth.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <complex>

#include "core/base/constants.h"
#include "irk/multiprecision.h"

namespace irk {

template <class Real>
Growth<Real>::Growth(const System<Real>& system, DerivativeSource source)
    : system_(system), differentiator_(system, source) {}

template <class Real>
double Growth<Real>::rate(const State<Real>& state, double time) {
  constexpr Index kMost = 50;
  const Sizes n = system_.sizes();
  const Index rates = n.nu + n.nx, size = n.nu + rates;
  if (size > kMost) return 0;
  differentiator_.evaluate(Level::kAcceleration, pointOf(state), D_);
  Mat<double> D0 = D_.dense0().template cast<double>(), right(n.n(), size);
  right << D_.dense2().leftCols(n.nu).template cast<double>(), D_.dense1().leftCols(rates).template cast<double>();
  if (!D0.allFinite() || !right.allFinite()) return 0;
  Equilibration<double> equilibration;
  equilibration.apply(*D_.pattern, D0.data());
  const Eigen::FullPivLU<Mat<double>> lu(D0);
  if (!lu.isInvertible()) return 0;
  Mat<double> J = Mat<double>::Zero(size, size);
  J.topRows(n.nu).middleCols(n.nu, n.nu).setIdentity();
  for (Index j = 0; j < size; ++j) {
    Vec<double> column = right.col(j);
    equilibration.scaleRight(column);
    column = lu.solve(column);
    equilibration.scaleBack(column);
    J.col(j).tail(rates) = -column.head(rates);
  }
  if (!J.allFinite()) return 0;
  const double round_off = kRoundOffUnits * std::numeric_limits<double>::epsilon() * J.norm();
  double largest = 0;
  const Eigen::EigenSolver<Mat<double>> solver(J, false);
  if (solver.info() != Eigen::Success) return 0;
  for (const std::complex<double>& lambda : solver.eigenvalues()) {
    const bool grows = lambda.real() * time > 1 && lambda.real() > round_off;
    if (grows) largest = std::max(largest, std::abs(lambda));
  }
  return largest;
}

IRK_INSTANTIATE_CLASS(Growth)

}  // namespace irk
