#include "core/integration/growth.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <complex>

#include "core/base/constants.h"
#include "irk/multiprecision.h"

namespace irk {

namespace {

// After so many time constants nothing is left of a decay in double precision: -ln 2.2e-16.
constexpr double kDecayed = 36;

}  // namespace

template <class Real>
Growth<Real>::Growth(const System<Real>& system, const Tolerances& tolerances, const Vec<double>& scale)
    : system_(system), differentiator_(system, DerivativeSource::kAutomatic), tolerances_(tolerances), scale_(scale) {}

template <class Real>
double Growth<Real>::speed(const State<Real>& s) {
  // Motions around 1 that had decayed moved by up to 70 eps.
  const double round_off = 100 * static_cast<double>(Real(Eigen::NumTraits<Real>::epsilon()));
  const Index nu = s.u.size(), nx = s.x.size();
  tolerance_.resize(2 * nu + nx);
  tolerance_ << s.u.template cast<double>(), s.v.template cast<double>(), s.x.template cast<double>();
  round_off_ = round_off * tolerance_.cwiseAbs();
  for (Index i = 0; i < tolerance_.size(); ++i) {
    tolerance_[i] = tolerances_.of(i < scale_.size() ? scale_[i] : 1, tolerance_[i]);
  }
  rates_.resize(tolerance_.size());
  rates_ << s.v.template cast<double>(), s.w.head(nu + nx).template cast<double>();
  return rates_.cwiseAbs().cwiseQuotient(tolerance_).maxCoeff();
}

// Sets J_; false if it is not known.
template <class Real>
bool Growth<Real>::linearize(const State<Real>& state) {
  const Sizes n = system_.sizes();
  const Index rates = n.nu + n.nx, size = n.nu + rates;
  if (size > kMost) return false;
  differentiator_.evaluate(Level::kAcceleration, pointOf(state), D_);
  Mat<double> D0 = D_.dense0().template cast<double>(), right(n.n(), size);
  right << D_.dense2().leftCols(n.nu).template cast<double>(), D_.dense1().leftCols(rates).template cast<double>();
  if (!D0.allFinite() || !right.allFinite()) return false;
  Equilibration<double> equilibration;
  equilibration.apply(*D_.pattern, D0.data());
  const Eigen::FullPivLU<Mat<double>> lu(D0);
  if (!lu.isInvertible()) return false;
  J_ = Mat<double>::Zero(size, size);
  J_.topRows(n.nu).middleCols(n.nu, n.nu).setIdentity();
  for (Index j = 0; j < size; ++j) {
    Vec<double> column = right.col(j);
    equilibration.scaleRight(column);
    column = lu.solve(column);
    equilibration.scaleBack(column);
    J_.col(j).tail(rates) = -column.head(rates);
  }
  lambda_round_off_ = kRoundOffUnits * std::numeric_limits<double>::epsilon() * J_.norm();
  return J_.allFinite();
}

template <class Real>
bool Growth<Real>::grows(const std::complex<double>& lambda, double time) const {
  return lambda.real() * time > 1 && lambda.real() > lambda_round_off_;
}

template <class Real>
double Growth<Real>::rate(const State<Real>& state, double time) {
  if (!linearize(state)) return 0;
  const Eigen::EigenSolver<Mat<double>> solver(J_, false);
  if (solver.info() != Eigen::Success) return 0;
  double largest = 0;
  for (const auto& lambda : solver.eigenvalues()) {
    if (grows(lambda, time)) largest = std::max(largest, std::abs(lambda));
  }
  return largest;
}

template <class Real>
auto Growth<Real>::motions(const State<Real>& state, double time, double since) -> std::optional<Motions> {
  const Eigen::EigenSolver<Mat<double>> solver(J_);
  if (solver.info() != Eigen::Success) return std::nullopt;
  Vec<double> f(J_.rows());
  f << state.v.template cast<double>(), state.w.head(f.size() - state.v.size()).template cast<double>();
  const auto& q = solver.eigenvectors();
  const Eigen::MatrixXcd inverse = q.partialPivLu().inverse();
  const Eigen::VectorXcd c = inverse * f;
  const Vec<double> noise = inverse.cwiseAbs() * round_off_;
  Motions of;
  bool any_further = false, any_vanished = false;
  for (Index i = 0; i < f.size(); ++i) {
    const std::complex<double> lambda = solver.eigenvalues()[i];
    const double distance = std::abs(c[i]) / std::abs(lambda);
    const bool lives = !(distance <= noise[i]);
    const bool is_driven = -lambda.real() * since > kDecayed;
    if (lives && !is_driven) of.living = std::max(of.living, std::abs(lambda));
    const bool rests = (distance * q.col(i).cwiseAbs().array() < tolerance_.array()).all();
    if (!grows(lambda, time) || !rests) continue;
    of.resting = std::max(of.resting, std::abs(lambda));
    of.faster = std::max(of.faster, lambda.real());
    (lives ? any_further : any_vanished) = true;
  }
  of.vanished = any_vanished && !any_further;
  return of;
}

IRK_INSTANTIATE_CLASS(Growth)

}  // namespace irk
