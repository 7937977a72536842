#include "core/estimates/defect.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "core/base/kept.h"
#include "core/base/legendre.h"
#include "core/base/small_product.h"
#include "core/base/threads.h"
#include "irk/multiprecision.h"

namespace irk {

template <class Real>
MovingPoints<Real>::MovingPoints(const Scheme<Real>& scheme, std::int64_t looks) {
  while (period_ < looks) stride_ = std::exchange(period_, period_ + stride_);
  if constexpr (std::is_same_v<Real, double>) {
    static Kept<Weights> all;
    std::string key = std::to_string(period_);
    appendKey(scheme.c, key);
    weights_ = all.of(key, [&] { return computed(scheme); });
  } else {
    weights_ = std::make_shared<const Weights>(computed(scheme));
  }
}

template <class Real>
double MovingPoints<Real>::place(std::int64_t i) const {
  return (static_cast<double>(i * stride_ % period_) + 0.5) / static_cast<double>(period_);
}

template <class Real>
auto MovingPoints<Real>::computed(const Scheme<Real>& scheme) const -> Weights {
  const Index s = scheme.s;
  Vec<Real> p(s + 2), integral(s + 1), second(s);
  Weights weights;
  weights.theta.resize(period_);
  for (auto* of : {&weights.inside, &weights.once, &weights.twice}) of->resize(s, period_);
  const auto& to_stages = scheme.legendre_inverse_transposed;
  for (Index i = 0; i < period_; ++i) {
    weights.theta[i] = Real(place(i));
    legendre<Real>(weights.theta[i], p);
    integrateLegendre(p, integral, second);
    weights.inside.col(i).noalias() = to_stages * p.head(s);
    weights.once.col(i).noalias() = to_stages * integral.head(s);
    weights.twice.col(i).noalias() = to_stages * second;
  }
  return weights;
}

template <class Real>
auto MovingPoints<Real>::block(std::int64_t i, std::int64_t most) const -> Block {
  const Index at = i % period_, s = weights_->inside.rows();
  const Index count = std::min<Index>(most, period_ - at);
  const auto columns = [&](const Mat<Real>& of) { return Eigen::Map<const Mat<Real>>(of.col(at).data(), s, count); };
  return {count, weights_->theta.data() + at, columns(weights_->inside), columns(weights_->once),
          columns(weights_->twice)};
}

template <class Real>
Defect<Real>::Defect(EmbeddedEstimate<Real>& filter, const Scheme<Real>& scheme, const Sizes& sizes, Start start,
                     std::int64_t looks)
    : filter_(filter),
      scheme_(scheme),
      sizes_(sizes),
      looks_at_start_(start == Start::kLookAt),
      looks_at_end_(scheme.c.maxCoeff() < Real(1 - 1e-10)),
      looks_(static_cast<double>(looks)),
      points_(scheme, looks),
      most_(sizes.n()),
      t_(kBlock),
      w_(sizes.n(), kBlock),
      u_(sizes.nu, kBlock),
      v_(sizes.nu, kBlock),
      x_(sizes.nx, kBlock) {}

template <class Real>
void Defect<Real>::begin(double length) {
  length_ = length;
  next_ = 0;
  forget();
}

std::int64_t looksInStep(double looks, double h, double length, std::int64_t most) {
  return static_cast<std::int64_t>(std::clamp(std::ceil(looks * h / length), 1.0, static_cast<double>(most)));
}

namespace {

template <class Result>
void add(Result& largest, const Result& one) {
  if (largest.outcome == Outcome::kSuccess) largest.outcome = one.outcome;
  largest.error = std::max(largest.error, one.error);
}

}  // namespace

// The largest one of `count` points from the point `first` on.
template <class Real>
auto Defect<Real>::among(std::int64_t first, std::int64_t count, const State<Real>& from,
                         const StagePolynomial<Real>& stages) -> Result {
  const Real& h = stages.h;
  const Index n = sizes_.n(), nu = sizes_.nu, nx = sizes_.nx;
  const int threads = filter_.threads();
  const Real* const W = stages.W.data();
  Result largest;
  for (const std::int64_t end = first + count; first < end;) {
    const auto block = points_.block(first, std::min<std::int64_t>(end - first, kBlock));
    productOnThreads(threads, W, n, n, block.inside, w_.data(), n);
    productOnThreads(threads, W, n, nu, block.twice, u_.data(), nu);
    productOnThreads(threads, W, n, nu, block.once, v_.data(), nu);
    productOnThreads(threads, W + nu, n, nx, block.once, x_.data(), nx);
    for (Index j = 0; j < block.count; ++j) {
      const Real& theta = block.theta[j];
      t_[j] = from.t + theta * h;
      inParts(threads, nu, [&](Index i, Index k) {
        for (; i < k; ++i) {
          u_(i, j) = from.u[i] + h * (theta * from.v[i] + h * u_(i, j));
          v_(i, j) = from.v[i] + h * v_(i, j);
        }
      });
      inParts(threads, nx, [&](Index i, Index k) {
        for (; i < k; ++i) x_(i, j) = from.x[i] + h * x_(i, j);
      });
    }
    add(largest, filter_.largestInside({sizes_, t_.data(), u_.data(), v_.data(), x_.data(), w_.data(), from.d.data()},
                                       block.count, h, most_));
    first += block.count;
  }
  return largest;
}

template <class Real>
auto Defect<Real>::at(std::int64_t i, const State<Real>& from, const StagePolynomial<Real>& stages) -> Result {
  most_.setZero();
  return among(i, 1, from, stages);
}

// At the start or the end of the step, where u, v, x are known and K has these weights.
template <class Real>
auto Defect<Real>::atEnd(const State<Real>& end, const Real& t, const Vec<Real>& d, const Vec<Real>& weights,
                         const StagePolynomial<Real>& stages) -> Result {
  inlinedProduct(stages.W.data(), sizes_.n(), sizes_.n(), weights, w_.data(), sizes_.n());
  return filter_.largestInside({sizes_, &t, end.u.data(), end.v.data(), end.x.data(), w_.data(), d.data()}, 1, stages.h,
                               most_);
}

template <class Real>
auto Defect<Real>::largest(const State<Real>& from, const StagePolynomial<Real>& stages, const State<Real>& to)
    -> Result {
  most_.setZero();
  const Real &t = stages.t, end = t + stages.h;
  const bool follows = seen_.has(t);
  const double h = follows && seen_.has(end) ? 0 : static_cast<double>(stages.h);
  const std::int64_t looks = looksInStep(looks_, h, length_, points_.period());
  Result largest = among(next_, looks, from, stages);
  next_ += looks;
  if (largest.outcome == Outcome::kSuccess && largest.error <= 1) {
    seen_ = {follows ? seen_.first : t, follows && seen_.last > end ? seen_.last : end};
  } else {
    forget();
  }
  most_.setZero();  // a filtered residual may be larger than that of another point and smaller in each row
  if (looks_at_start_) add(largest, atEnd(from, from.t, from.d, scheme_.start, stages));
  most_.setZero();
  if (looks_at_end_) add(largest, atEnd(to, from.t + stages.h, from.d, scheme_.end, stages));
  return largest;
}

template class MovingPoints<double>;
template class MovingPoints<BigFloat>;
IRK_INSTANTIATE_CLASS(Defect)

}  // namespace irk
