#include "core/stages/error_norm.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/small_size.h"
#include "core/base/threads.h"
#include "core/system/component_scale.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

double square(double x) { return x * x; }

// h^power for a small integer power >= 0.
double powerOf(double h, int power) {
  double f = 1;
  for (int i = 0; i < power; ++i) f *= h;
  return f;
}

// sum of f(i), i < n. Eight sums at a time: one sum alone would make each addition wait for the one before.
template <class F>
[[gnu::always_inline]] inline double sumOf(Index n, const F& f) {
  constexpr Index kSums = 8;
  double sum = 0;
  Index i = 0;
  if (n >= kSums) {
    std::array<double, kSums> sums{};
    for (; i + kSums <= n; i += kSums) {
      for (Index j = 0; j < kSums; ++j) sums[static_cast<std::size_t>(j)] += f(i + j);
    }
    sum = ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]));
  }
  for (; i < n; ++i) sum += f(i);
  return sum;
}

// sum of weight_i d_ij^2 over N rows and `count` columns. Each row has its own sum, so that additions do not wait for
// each other.
template <class Real, Index N>
[[gnu::always_inline]] inline double sumOfRows(const Real* d, const double* weight, std::integral_constant<Index, N>,
                                               Index count) {
  const auto sum = [=](auto columns) {
    std::array<double, static_cast<std::size_t>(N)> rows{};
    for (Index j = 0; j < columns; ++j) {
      for (Index i = 0; i < N; ++i) rows[static_cast<std::size_t>(i)] += square(static_cast<double>(d[j * N + i]));
    }
    double all = 0;
    for (Index i = 0; i < N; ++i) all += weight[i] * rows[static_cast<std::size_t>(i)];
    return all;
  };
  return withSize<3>(count, sum);
}

}  // namespace

template <class Real>
ErrorNorm<Real>::ErrorNorm(const System<Real>& system, const Tolerances& tolerances, const Vec<double>& scale)
    : sizes_(system.sizes()),
      powers_(system.errorPowers()),
      index3_(powers_.isIndex3()),
      tolerances_(tolerances),
      scale_(componentScale(sizes_, scale)),
      weight_(Vec<double>::Ones(sizes_.components())) {
  if (tolerances.norm == NormKind::kAbsolute) scale_.setOnes();
}

template <class Real>
void ErrorNorm<Real>::setScale(const Vec<double>& first) {
  first_scale_ = first;
}

template <class Real>
double ErrorNorm<Real>::weightOf(Index i, double value) const {
  const double scale = i < first_scale_.size() ? first_scale_[i] : scale_[i];
  const bool absolute = tolerances_.norm == NormKind::kAbsolute;
  return absolute ? tolerances_.atol * std::min(1.0, scale + std::abs(value)) : tolerances_.of(scale, value);
}

template <class Real>
void ErrorNorm<Real>::weightsAtZero(Vec<double>& weights) const {
  for (Index i = 0; i < weights.size(); ++i) weights[i] = weightOf(i, 0);
}

template <class Real>
void ErrorNorm<Real>::update(const State<Real>& y) {
  const auto weigh = [&](Index offset, const auto& part) {
    for (Index i = 0; i < part.size(); ++i) {
      weight_[offset + i] = weightOf(offset + i, static_cast<double>(part[i]));
    }
  };
  weigh(0, y.u);
  weigh(sizes_.nu, y.v);
  weigh(2 * sizes_.nu, y.x);
  weigh(2 * sizes_.nu + sizes_.nx, y.z());
  if (!leaves_multipliers_out_) return;
  constexpr double kNothing = std::numeric_limits<double>::infinity();
  weight_.segment(2 * sizes_.nu + sizes_.nx, sizes_.constraints).setConstant(kNothing);
}

template <class Real>
double ErrorNorm<Real>::zFactor(double h, Index i) const {
  return powerOf(h, powers_.z[static_cast<std::size_t>(i)]);
}

// Calls f(component, its weighted difference) for all components of u, v, x, z.
template <class Real>
template <class F>
void ErrorNorm<Real>::forEachPart(const State<Real>& p, const State<Real>& q, double h, const Vec<double>& factor,
                                  F&& f) const {
  const auto add = [&](Index offset, const auto& a, const auto& b, const auto& weigh) {
    for (Index i = 0; i < a.size(); ++i) {
      const double e = static_cast<double>(Real(a[i] - b[i]));
      f(offset + i, factor[offset + i] * weigh(i) * e / weight_[offset + i]);
    }
  };
  const auto one = [](Index) { return 1.0; };
  add(0, p.u, q.u, one);
  add(sizes_.nu, p.v, q.v, one);
  add(2 * sizes_.nu, p.x, q.x, one);
  add(2 * sizes_.nu + sizes_.nx, p.z(), q.z(), [&](Index i) { return zFactor(h, i); });
}

template <class Real>
double ErrorNorm<Real>::difference(const State<Real>& p, const State<Real>& q, double h,
                                   const Vec<double>& factor) const {
  double sum = 0;
  forEachPart(p, q, h, factor, [&](Index, double part) { sum += square(part); });
  return total(sum);
}

template <class Real>
Index ErrorNorm<Real>::worst(const State<Real>& p, const State<Real>& q, double h, const Vec<double>& factor) const {
  Index worst = -1;
  double most = -1;
  forEachPart(p, q, h, factor, [&](Index i, double part) {
    if (std::abs(part) > most) worst = i, most = std::abs(part);
  });
  return worst;
}

template <class Real>
double ErrorNorm<Real>::magnitude(const State<Real>& e, double h) const {
  double sum = 0;
  const auto add = [&](Index offset, const auto& a, const auto& weigh) {
    const double* const weight = weight_.data() + offset;
    sum += sumOf(a.size(), [&](Index i) { return square(weigh(i) * static_cast<double>(a[i]) / weight[i]); });
  };
  const auto one = [](Index) { return 1.0; };
  add(0, e.u, one);
  add(sizes_.nu, e.v, one);
  add(2 * sizes_.nu, e.x, one);
  add(2 * sizes_.nu + sizes_.nx, e.z(), [&](Index i) { return zFactor(h, i); });
  return total(sum);
}

template <class Real>
double ErrorNorm<Real>::total(double sum) const {
  if (tolerances_.norm == NormKind::kAbsolute) return std::sqrt(sum);
  return std::sqrt(sum / static_cast<double>(sizes_.components()));
}

template <class Real>
void ErrorNorm<Real>::rowWeights(double h, Vec<double>& squares) const {
  const Index nu = sizes_.nu, nx = sizes_.nx, nz = sizes_.nz;
  const double* const wu = weight_.data();
  const double* const wv = wu + nu;
  const double* const wx = wv + nu;
  const double* const wz = wx + nx;
  for (Index i = 0; i < nu; ++i) {
    const double f = powerOf(h, powers_.v[static_cast<std::size_t>(i)]);
    squares[i] = square(f * h / wv[i]) + square(h * h / wu[i]);
  }
  for (Index i = 0; i < nx; ++i) {
    const double f = powerOf(h, powers_.x[static_cast<std::size_t>(i)]);
    squares[nu + i] = square(f * h / wx[i]);
  }
  for (Index i = 0; i < nz; ++i) squares[nu + nx + i] = square(zFactor(h, i) / wz[i]);
}

template <class Real>
double ErrorNorm<Real>::increment(const Mat<Real>& dW, Index first, const Vec<double>& squares, int threads) const {
  const Index count = dW.cols() - first;
  const double sum = withSize<unrolledSizes<Real>(8)>(dW.rows(), [&](auto n) {
    const Real* const columns = dW.data() + first * n;
    const double* const weight = squares.data();
    if constexpr (std::is_same_v<decltype(n), Index>) {
      return sumOnThreads<double>(threads, count, n, [=](Index j) {
        const Real* const column = columns + j * n;
        return sumOf(n, [=](Index i) { return weight[i] * square(static_cast<double>(column[i])); });
      });
    } else {
      return sumOfRows(columns, weight, n, count);
    }
  });
  return std::sqrt(sum * (1 / static_cast<double>(sizes_.components() * count)));
}

IRK_INSTANTIATE_CLASS(ErrorNorm)

}  // namespace irk
