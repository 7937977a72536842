#include "core/linear/interleaved_lu.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/base/threads.h"
#include "core/linear/complex_arithmetic.h"

namespace irk {
namespace {

constexpr std::size_t kMaxLanes = 8;
// The compiler fuses other products and sums in scalar code than in vectors: with a single lane last bits would differ.
constexpr std::size_t kMinWidth = 2;

// Calls f with the width of a group as a constant: 2, 4 or 8.
template <class F>
decltype(auto) withWidth(std::size_t width, const F& f) {
  switch (width) {
    case 2:
      return f(std::integral_constant<int, 2>());
    case 4:
      return f(std::integral_constant<int, 4>());
    default:
      return f(std::integral_constant<int, 8>());
  }
}

template <int kWidth>
struct Pack {
  using Array = Eigen::Array<double, kWidth, 1>;
  using In = Eigen::Map<const Array>;
  using Out = Eigen::Map<Array>;
};

// Left-looking LU of all lanes, column by column, as in SparseLu. Lanes without a matrix repeat the first one. A pivot
// that is zero or not finite makes numbers that are not finite from there on, which the sum of all pivots shows.
template <int kWidth>
struct Elimination {
  using Array = typename Pack<kWidth>::Array;
  using In = typename Pack<kWidth>::In;
  using Out = typename Pack<kWidth>::Out;
  static constexpr std::size_t kSize = std::size_t{2} * kWidth;

  const SparsePivots& f;
  double* x;  // the column; zero again after each
  double *l, *u, *inverse;
  double *first_l, *first_u, *first_inverse;  // those of the first lane alone, or null
  Array m1r = {}, m1i = {}, m2r = {}, m2i = {};
  Array least = {}, most = {}, sum = {};  // magnitudes of the pivots
  Array multiplier = {};                  // largest magnitude in L

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  void begin(std::span<const std::complex<double>> m) {
    for (int i = 0; i < kWidth; ++i) {
      const std::complex<double> own = m[index(i) < m.size() ? index(i) : 0];
      m1r[i] = own.real();
      m1i[i] = own.imag();
    }
    m2r = m1r * m1r - m1i * m1i;
    m2i = 2 * m1r * m1i;
    least.setConstant(std::numeric_limits<double>::infinity());
    most = sum = multiplier = Array::Zero();
    std::fill_n(x, f.p.size() * kSize, 0.0);
  }

  void fill(std::size_t k, const InterleavedLu::Pencil& pencil, const std::vector<int>& row_of) {
    for (std::size_t e = index(f.source_start[k]); e < index(f.source_start[k + 1]); ++e) {
      const std::size_t entry = index(f.source[e]), row = index(f.target[e]);
      const double scale = f.scale[row] * pencil.row_scales[row_of[entry]];
      const double d0 = scale * pencil.d0[entry], d1 = scale * pencil.d1[entry], d2 = scale * pencil.d2[entry];
      double* const to = x + row * kSize;
      Out{to} = d0 + m1r * d1 + m2r * d2;
      Out{to + kWidth} = m1i * d1 + m2i * d2;
    }
  }

  void eliminate(std::size_t k) {
    for (std::size_t e = index(f.u_start[k]); e < index(f.u_start[k + 1]); ++e) {
      const std::size_t j = index(f.u_row[e]);
      double* const here = x + j * kSize;
      const Array re = In(here), im = In(here + kWidth);
      Out{u + e* kSize} = re;
      Out{u + e* kSize + kWidth} = im;
      if (first_u) first_u[e] = re[0];
      std::fill_n(here, kSize, 0.0);
      for (std::size_t i = index(f.l_start[j]); i < index(f.l_start[j + 1]); ++i) {
        double* const below = x + index(f.l_row[i]) * kSize;
        const Array a = In(l + i * kSize), b = In(l + i * kSize + kWidth);
        Out{below} -= a * re - b * im;
        Out{below + kWidth} -= a * im + b * re;
      }
    }
  }

  void divide(std::size_t k, bool fresh) {
    double* const diagonal = x + k * kSize;
    const Array re = In(diagonal), im = In(diagonal + kWidth);
    const Array size = re.abs() + im.abs(), inverse_square = (re * re + im * im).inverse();
    least = least.min(size);
    most = most.max(size);
    sum += size;
    const Array a = re * inverse_square, b = -im * inverse_square;
    Out{inverse + k* kSize} = a;
    Out{inverse + k* kSize + kWidth} = b;
    if (first_inverse) first_inverse[k] = a[0];
    std::fill_n(diagonal, kSize, 0.0);
    for (std::size_t e = index(f.l_start[k]); e < index(f.l_start[k + 1]); ++e) {
      double* const below = x + index(f.l_row[e]) * kSize;
      const Array c = In(below), d = In(below + kWidth);
      const Array lr = c * a - d * b, li = c * b + d * a;
      Out{l + e* kSize} = lr;
      Out{l + e* kSize + kWidth} = li;
      if (first_l) first_l[e] = lr[0];
      if (fresh) multiplier = multiplier.max(lr.abs() + li.abs());
      std::fill_n(below, kSize, 0.0);
    }
  }
};

}  // namespace

InterleavedLu::Group::Group(std::size_t first_, std::size_t lanes_, const SparseAnalysis& analysis)
    : first(first_),
      lanes(lanes_),
      width(std::max(kMinWidth, std::bit_ceil(lanes_))),
      inverse_diagonal(static_cast<std::size_t>(analysis.n()) * 2 * width),
      chosen_at(width),
      work(inverse_diagonal.size()) {
  // Twice the predicted fill, because pivots may change; real and imaginary parts.
  l.reserve(2 * analysis.lowerEntries() * 2 * width);
  u.reserve(2 * analysis.upperEntries() * 2 * width);
}

InterleavedLu::InterleavedLu(std::shared_ptr<const SparseAnalysis> analysis, std::size_t matrices, int threads)
    : analysis_(std::move(analysis)), choice_(analysis_), threads_(threads) {
  analysis_->reserve(pivots_);
  const std::size_t by_thread = (matrices + static_cast<std::size_t>(threads) - 1) / static_cast<std::size_t>(threads);
  const std::size_t most = std::min(kMaxLanes, by_thread);
  for (std::size_t first = 0; first < matrices; first += most) {
    groups_.emplace_back(first, std::min(most, matrices - first), *analysis_);
  }
  l_.reserve(2 * analysis_->lowerEntries());
  u_.reserve(2 * analysis_->upperEntries());
  inverse_diagonal_.reserve(static_cast<std::size_t>(analysis_->n()));
}

bool InterleavedLu::factorize(const Pencil& pencil, std::span<const std::complex<double>> m) {
  if (pivoted_ && refactorize(pencil, m, false)) return true;
  pivoted_ = choosePivots(pencil, m.front()) && refactorize(pencil, m, true);
  return pivoted_;
}

bool InterleavedLu::choosePivots(const Pencil& pencil, std::complex<double> m) {
  const std::complex<double> m2 = detail::product(m, m);
  const std::vector<int>& row = analysis_->row;
  for (std::size_t k = 0; k < row.size(); ++k) {
    choice_.values()[k] = pencil.row_scales[row[k]] * (pencil.d0[k] + m * pencil.d1[k] + m2 * pencil.d2[k]);
  }
  ++pivotings_;
  if (!choice_.entries().allFinite() || !choice_.choose(pivots_)) return false;
  if (m.imag() == 0) {
    detail::fit(l_, pivots_.l_row.size());
    detail::fit(u_, pivots_.u_row.size());
    inverse_diagonal_.resize(pivots_.p.size());
  }
  for (Group& group : groups_) {
    detail::fit(group.l, pivots_.l_row.size() * 2 * group.width);
    detail::fit(group.u, pivots_.u_row.size() * 2 * group.width);
  }
  return true;
}

bool InterleavedLu::refactorize(const Pencil& pencil, std::span<const std::complex<double>> m, bool fresh) {
  onThreads(threads_, groups_.size(), [&](std::size_t i) {
    Group& group = groups_[i];
    const auto own = m.subspan(group.first, group.lanes);
    group.good = withWidth(
        group.width, [&](auto width) { return refactorizeGroup<decltype(width)::value>(group, pencil, own, fresh); });
  });
  return std::all_of(groups_.begin(), groups_.end(), [](const Group& group) { return group.good; });
}

template <int kWidth>
bool InterleavedLu::refactorizeGroup(Group& group, const Pencil& pencil, std::span<const std::complex<double>> m,
                                     bool fresh) {
  const bool copies = &group == &groups_.front() && m.front().imag() == 0;
  Elimination<kWidth> lu{.f = pivots_,
                         .x = group.work.data(),
                         .l = group.l.data(),
                         .u = group.u.data(),
                         .inverse = group.inverse_diagonal.data(),
                         .first_l = copies ? l_.data() : nullptr,
                         .first_u = copies ? u_.data() : nullptr,
                         .first_inverse = copies ? inverse_diagonal_.data() : nullptr};
  lu.begin(m);
  for (std::size_t k = 0; k < pivots_.p.size(); ++k) {
    lu.fill(k, pencil, analysis_->row);
    lu.eliminate(k);
    lu.divide(k, fresh);
  }
  for (std::size_t i = 0; i < group.lanes; ++i) {
    const auto lane = static_cast<Index>(i);
    if (!(lu.least[lane] > 0) || !std::isfinite(lu.sum[lane])) return false;
    const double condition = lu.least[lane] / lu.most[lane];
    if (fresh) {
      if (lu.multiplier[lane] > kMostMultiplier) return false;
      group.chosen_at[i] = condition;
    } else if (condition < kSmallerPivot * group.chosen_at[i]) {
      return false;
    }
  }
  return true;
}

void InterleavedLu::solveFirst(double* b) {
  const SparsePivots& f = pivots_;
  const std::size_t n = f.p.size();
  double* const x = groups_.front().work.data();
  for (std::size_t k = 0; k < n; ++k) x[k] = b[f.p[k]] * f.scale[k];
  for (std::size_t k = 0; k < n; ++k) {
    for (auto e = static_cast<std::size_t>(f.l_start[k]); e < static_cast<std::size_t>(f.l_start[k + 1]); ++e) {
      x[f.l_row[e]] -= l_[e] * x[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    const double here = x[k] * inverse_diagonal_[k];
    for (auto e = static_cast<std::size_t>(f.u_start[k]); e < static_cast<std::size_t>(f.u_start[k + 1]); ++e) {
      x[f.u_row[e]] -= u_[e] * here;
    }
    b[f.q[k]] = here;
  }
}

void InterleavedLu::solve(std::span<const Lane> lanes) {
  onThreads(threads_, groups_.size(), [&](std::size_t i) {
    Group& group = groups_[i];
    const auto own = lanes.subspan(group.first, group.lanes);
    withWidth(group.width, [&](auto width) { solveGroup<decltype(width)::value>(group, own); });
  });
}

template <int kWidth>
void InterleavedLu::solveGroup(Group& group, std::span<const Lane> lanes) {
  using Array = typename Pack<kWidth>::Array;
  using In = typename Pack<kWidth>::In;
  using Out = typename Pack<kWidth>::Out;
  const SparsePivots& f = pivots_;
  const std::size_t n = f.p.size();
  constexpr std::size_t kSize = std::size_t{2} * kWidth;
  double* const x = group.work.data();
  std::fill_n(x, n * kSize, 0.0);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const Lane lane = lanes[i];
    double* at = x + i;
    for (std::size_t k = 0; k < n; ++k, at += kSize) at[0] = f.scale[k] * lane.re[f.p[k]];
    if (!lane.im) continue;
    at = x + kWidth + i;
    for (std::size_t k = 0; k < n; ++k, at += kSize) {
      at[0] = f.scale[k] * (lane.sigma * lane.im[f.p[k]]);
    }
  }
  // Subtracts column k times (re, im) from x.
  const auto eliminate = [x](const std::vector<int>& start, const std::vector<int>& row,
                             const std::vector<double>& value, std::size_t k, const Array& re, const Array& im) {
    for (auto e = static_cast<std::size_t>(start[k]); e < static_cast<std::size_t>(start[k + 1]); ++e) {
      const double* const entry = value.data() + e * kSize;
      double* const at = x + static_cast<std::size_t>(row[e]) * kSize;
      const Array a = In(entry), b = In(entry + kWidth);
      Out{at} -= a * re - b * im;
      Out{at + kWidth} -= a * im + b * re;
    }
  };
  for (std::size_t k = 0; k < n; ++k) {
    const Array re = In(x + k * kSize), im = In(x + k * kSize + kWidth);
    eliminate(f.l_start, f.l_row, group.l, k, re, im);
  }
  for (std::size_t k = n; k-- > 0;) {
    double* const at = x + k * kSize;
    const double* const pivot = group.inverse_diagonal.data() + k * kSize;
    const Array a = In(pivot), b = In(pivot + kWidth), re0 = In(at), im0 = In(at + kWidth);
    const Array re = a * re0 - b * im0, im = a * im0 + b * re0;
    eliminate(f.u_start, f.u_row, group.u, k, re, im);
    Out{at} = re;
    Out{at + kWidth} = im;
  }
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const Lane lane = lanes[i];
    const double* at = x + i;
    for (std::size_t k = 0; k < n; ++k, at += kSize) lane.re[f.q[k]] = at[0];
    if (!lane.im) continue;
    at = x + kWidth + i;
    for (std::size_t k = 0; k < n; ++k, at += kSize) lane.im[f.q[k]] = at[0] * lane.inverse_sigma;
  }
}

}  // namespace irk
