#include "core/estimates/error_transport.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "irk/multiprecision.h"

namespace irk {
namespace {

// A E is computed from a start that differs by a multiple of E. The difference, relative to the components, is small
// where the equations are nonlinear, but large against round-off (eps^kDifferencePower) and against what Newton's
// method leaves in a step, a small part of the tolerance.
constexpr double kDifferencePower = 0.4;
constexpr double kTolerances = 3;

// target += factor (p - q) for all components.
template <class Real>
void addDifference(const State<Real>& p, const State<Real>& q, const Vec<double>& factor, State<Real>& target) {
  const Index nu = p.u.size(), nx = p.x.size();
  const auto add = [&](Index offset, const auto& a, const auto& b, auto&& sum) {
    for (Index i = 0; i < a.size(); ++i) sum[i] += Real(factor[offset + i]) * (a[i] - b[i]);
  };
  add(0, p.u, q.u, target.u);
  add(nu, p.v, q.v, target.v);
  add(2 * nu, p.x, q.x, target.x);
  add(nu, p.a(), q.a(), target.a());
  add(2 * nu, p.k(), q.k(), target.k());
  add(2 * nu + nx, p.z(), q.z(), target.z());
}

template <class Real>
void setZero(State<Real>& s) {
  for (auto* part : {&s.u, &s.v, &s.x, &s.w}) part->setZero();
}

}  // namespace

template <class Real>
ErrorTransport<Real>::ErrorTransport(const Sizes& sizes, Index stages)
    : sizes_(sizes),
      error_(sizes),
      next_(sizes),
      start_(sizes),
      end_(sizes),
      local_(sizes),
      scratch_(sizes.n(), stages) {}

template <class Real>
void ErrorTransport<Real>::begin() {
  setZero(error_);
  lost_ = false;
  sum_ = 0;
}

template <class Real>
void ErrorTransport<Real>::carry(Stepper<Real>& stepper, const State<Real>& from, const State<Real>& whole,
                                 const State<Real>& fine, const Vec<double>& factor, const ErrorNorm<Real>& norm) {
  loses_ = false;
  if (lost_) return;
  const double size = this->size(norm);
  next_ = error_;
  if (size > 0) {
    const double eps = static_cast<double>(Real(Eigen::NumTraits<Real>::epsilon()));
    const double difference = std::max(std::pow(eps, kDifferencePower), kTolerances * norm.tolerance());
    const Real scale = Real(difference / (size * norm.tolerance()));
    start_ = from;
    start_.u += scale * error_.u;
    start_.v += scale * error_.v;
    start_.x += scale * error_.x;
    start_.w += scale * error_.w;
    loses_ = stepper.endFrom(start_, end_, scratch_) != Outcome::kSuccess;
    if (loses_) return;
    next_.u = (end_.u - whole.u) / scale;
    next_.v = (end_.v - whole.v) / scale;
    next_.x = (end_.x - whole.x) / scale;
    next_.w = (end_.w - whole.w) / scale;
  }
  setZero(local_);
  addDifference(whole, fine, factor, local_);
  added_ = sizeOf(local_, norm);
  next_.u += local_.u;
  next_.v += local_.v;
  next_.x += local_.x;
  next_.w += local_.w;
}

template <class Real>
double ErrorTransport<Real>::size(const ErrorNorm<Real>& norm) const {
  return lost_ ? std::numeric_limits<double>::quiet_NaN() : sizeOf(error_, norm);
}

template <class Real>
double ErrorTransport<Real>::amplification(const ErrorNorm<Real>& norm) const {
  return sum_ > 0 ? size(norm) / sum_ : 0;
}

template <class Real>
double ErrorTransport<Real>::sizeOf(const State<Real>& error, const ErrorNorm<Real>& norm) const {
  double largest = 0;
  const auto look = [&](Index offset, const auto& e) {
    for (Index i = 0; i < e.size(); ++i) {
      largest = std::max(largest, std::abs(static_cast<double>(e[i])) / norm.weights()[offset + i]);
    }
  };
  look(0, error.u);
  look(sizes_.nu, error.v);
  look(2 * sizes_.nu, error.x);
  return largest;
}

IRK_INSTANTIATE_CLASS(ErrorTransport)

}  // namespace irk
