#include "core/derivatives/constraint_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>
#include <Eigen/SVD>

#include "core/base/constants.h"
#include "core/derivatives/constraint_check.h"
#include "core/system/component_scale.h"
#include "irk/dependent_constraints.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

// Gram and Schmidt, each column twice: then Q is orthogonal to round-off (Golub & Van Loan, section 5.2.9). A column
// that depends on those before becomes zero in Q.
void orthogonalize(ConstraintFrame& f) {
  const Index n = f.Gt.rows(), m = f.Gt.cols();
  f.finite = f.Gt.allFinite();
  f.rank = 0;
  f.R.setZero();
  for (Index j = 0; f.finite && j < m; ++j) {
    auto q = f.Q.col(j);
    q = f.Gt.col(j);
    const double length = q.norm();
    for (int pass = 0; pass < 2; ++pass) {
      for (Index i = 0; i < j; ++i) {
        const double part = f.Q.col(i).dot(q);
        f.R(i, j) += part;
        q -= part * f.Q.col(i);
      }
    }
    const double left = q.norm();
    // The round-off of the sums of n products above.
    if (!(left > static_cast<double>(n) * kEps * length)) {
      q.setZero();
      continue;
    }
    f.R(j, j) = left;
    q /= left;
    ++f.rank;
  }
}

// The rows of the constraints that are not left out.
template <class Real>
std::vector<Index> constraintRows(const System<Real>& system) {
  const Sizes n = system.sizes();
  const auto& left_out = system.leftOut();
  std::vector<Index> rows;
  for (Index i = 0; i < n.constraints; ++i) {
    if (std::find(left_out.begin(), left_out.end(), i) == left_out.end()) rows.push_back(n.nu + n.nx + i);
  }
  return rows;
}

// R^T y = g, in place: |y| = |G^+ g|.
void solveTransposed(const Mat<double>& R, Vec<double>& y) {
  for (Index i = 0; i < y.size(); ++i) {
    for (Index k = 0; k < i; ++k) y[i] -= R(k, i) * y[k];
    y[i] /= R(i, i);
  }
}

// Gaussian elimination with pivots; destroys A.
double determinant(Mat<double>& A) {
  double product = 1;
  for (Index k = 0; k < A.cols(); ++k) {
    Index pivot = k;
    for (Index i = k + 1; i < A.rows(); ++i) {
      if (std::abs(A(i, k)) > std::abs(A(pivot, k))) pivot = i;
    }
    if (A(pivot, k) == 0) return 0;
    if (pivot != k) {
      product = -product;
      for (Index j = k; j < A.cols(); ++j) std::swap(A(k, j), A(pivot, j));
    }
    product *= A(k, k);
    for (Index i = k + 1; i < A.rows(); ++i) {
      const double factor = A(i, k) / A(k, k);
      for (Index j = k + 1; j < A.cols(); ++j) A(i, j) -= factor * A(k, j);
    }
  }
  return product;
}

}  // namespace

double turned(const ConstraintFrame& a, const ConstraintFrame& b, Mat<double>& scratch) {
  for (Index j = 0; j < b.Q.cols(); ++j) {
    for (Index i = 0; i < a.Q.cols(); ++i) scratch(i, j) = a.Q.col(i).dot(b.Q.col(j));
  }
  return determinant(scratch);
}

template <class Real>
ConstraintFrames<Real>::ConstraintFrames(const System<Real>& system, const Vec<double>& scale)
    : outer_(system),
      system_(constrainedIn(system)),
      positions_(system.sceneSizes().nu),
      constraints_(system_.sizes().constraints - static_cast<Index>(system_.leftOut().size())),
      rows_(constraintRows(system_)),
      scale_(componentScale(system.sizes(), scale).head(positions_)),
      at_(system_.sizes()),
      dual_(system_.sizes()),
      r_(system_.sizes().n()),
      moved_(positions_),
      g_(constraints_),
      step_(constraints_),
      rest_(constraints_) {}

template <class Real>
ConstraintFrame ConstraintFrames<Real>::make() const {
  ConstraintFrame frame;
  frame.u = Vec<double>::Zero(positions_);
  frame.Gt = frame.Q = Mat<double>::Zero(positions_, constraints_);
  frame.R = Mat<double>::Zero(constraints_, constraints_);
  return frame;
}

template <class Real>
ConstVec<Real> ConstraintFrames<Real>::positions(const State<Real>& state) const {
  return {outer_.secondOrder() ? state.u.data() : state.x.data(), positions_};
}

template <class Real>
ConstVec<Real> ConstraintFrames<Real>::velocities(const State<Real>& state) const {
  return {outer_.secondOrder() ? state.v.data() : state.x.data() + positions_, positions_};
}

// The state in the unknowns of the system that is evaluated. Its (a, k, z) do not enter the constraints.
template <class Real>
void ConstraintFrames<Real>::place(const State<Real>& state, const Real& t) {
  if (outer_.sizes().constraints > 0) {
    at_.u = state.u, at_.v = state.v, at_.x = state.x, at_.w = state.w;
  } else {  // first-order form: its x is (u, v, x)
    at_.u = state.x.head(positions_);
    at_.v = state.x.segment(positions_, positions_);
    at_.x = state.x.tail(at_.x.size());
  }
  at_.d = state.d;
  at_.t = t;
}

template <class Real>
void ConstraintFrames<Real>::setPositions(const Vec<Real>& u) {
  if (system_.secondOrder()) {
    at_.u = u;
  } else {
    at_.x.head(positions_) = u;
  }
}

// dg/dt = G v + dg/dt(u, 0) is differentiated with respect to v.
template <class Real>
void ConstraintFrames<Real>::evaluate(const State<Real>& state, const Real& t, const Vec<Real>& u,
                                      ConstraintFrame& out) {
  place(state, t);
  setPositions(u);
  out.t = sceneTime(system_, t);
  for (Index j = 0; j < positions_; ++j) out.u[j] = static_cast<double>(u[j]);
  dual_.copy(pointOf(at_));
  const auto chunk = static_cast<Index>(kChunk);
  const auto v = [&](Index j) -> Dual<Real>& { return system_.secondOrder() ? dual_.v[j] : dual_.x[positions_ + j]; };
  for (Index first = 0; first < positions_; first += chunk) {
    const Index count = std::min(chunk, positions_ - first);
    for (Index c = 0; c < count; ++c) v(first + c).d[static_cast<std::size_t>(c)] = Real(1);
    system_.evaluate(Level::kVelocity, dual_.at(Dual<Real>(t)), dual_.residual());
    for (Index c = 0; c < count; ++c) {
      v(first + c).d[static_cast<std::size_t>(c)] = Real(0);
      for (Index i = 0; i < constraints_; ++i) {
        out.Gt(first + c, i) =
            scale_[first + c] *
            static_cast<double>(dual_.r[rows_[static_cast<std::size_t>(i)]].d[static_cast<std::size_t>(c)]);
      }
    }
  }
  orthogonalize(out);
}

template <class Real>
void ConstraintFrames<Real>::constraintsAt(const Vec<Real>& u, Vec<double>& g) {
  setPositions(u);
  system_.evaluate(Level::kPosition, pointOf(at_), VecView<Real>(r_.data(), r_.size()));
  for (Index i = 0; i < constraints_; ++i) g[i] = static_cast<double>(r_[rows_[static_cast<std::size_t>(i)]]);
}

// g(u - s G^+ g) = (1 - s) g + s^2 q: q, which one Newton step (s = 1) leaves, is measured where the round-off of g
// does not hide it: eps^(1/3) away, as second differences are (Dennis & Schnabel, section 5.4), or further.
template <class Real>
double ConstraintFrames<Real>::newtonRest(const ConstraintFrame& frame) {
  constexpr double kAway = 6e-6;  // eps^(1/3)
  constexpr double kFurther = 8;  // of the Newton step itself: the error of g there is that of q divided by 64
  for (Index j = 0; j < positions_; ++j) moved_[j] = Real(frame.u[j]);
  constraintsAt(moved_, g_);
  step_ = g_;
  solveTransposed(frame.R, step_);
  const double length = step_.norm();
  if (!(length > 0)) return 0;
  const double s = std::max(kFurther, kAway / length);
  for (Index j = 0; j < positions_; ++j) {
    double move = 0;
    for (Index i = 0; i < constraints_; ++i) move += frame.Q(j, i) * step_[i];
    moved_[j] = Real(frame.u[j] - s * move * scale_[j]);
  }
  constraintsAt(moved_, rest_);
  for (Index i = 0; i < constraints_; ++i) rest_[i] = (rest_[i] - (1 - s) * g_[i]) / s / s;
  solveTransposed(frame.R, rest_);
  return rest_.norm() / length;
}

template <class Real>
Index ConstraintFrames<Real>::weakest(const ConstraintFrame& frame, const ConstraintFrame& regular) const {
  Mat<double> scaled = frame.Gt;
  for (Index i = 0; i < constraints_; ++i) scaled.col(i) /= regular.Gt.col(i).norm();
  const Eigen::JacobiSVD<Mat<double>> svd(scaled, Eigen::ComputeFullV);
  Index largest = 0;
  svd.matrixV().col(constraints_ - 1).cwiseAbs().maxCoeff(&largest);
  return rows_[static_cast<std::size_t>(largest)] - system_.sizes().nu - system_.sizes().nx;
}

template <class Real>
std::vector<Index> dependentConstraints(const System<Real>& system, const State<Real>& start,
                                        const Vec<double>& scale) {
  ConstraintFrames<Real> frames(system, scale);
  if (frames.constraints() == 0) return {};
  ConstraintFrame frame = frames.make();
  frames.evaluate(start, start.t, start.u, frame);
  if (!frame.finite) return {};
  for (auto gradient : frame.Gt.colwise()) gradient.normalize();
  const Eigen::ColPivHouseholderQR<Mat<double>> qr(frame.Gt);
  const auto& pivots = qr.colsPermutation().indices();
  std::vector<Index> dependent;
  for (Index k = 0; k < frames.constraints(); ++k) {
    const bool independent = k < frame.Gt.rows() && std::abs(qr.matrixQR()(k, k)) > kEightDigits;
    if (!independent) dependent.push_back(pivots[k]);
  }
  std::sort(dependent.begin(), dependent.end());
  return dependent;
}

IRK_INSTANTIATE_CLASS(ConstraintFrames)
#define IRK_DEPENDENT(Real) \
  template std::vector<Index> dependentConstraints(const System<Real>&, const State<Real>&, const Vec<double>&);
IRK_DEPENDENT(double)
IRK_DEPENDENT(BigFloat)
#undef IRK_DEPENDENT

}  // namespace irk
