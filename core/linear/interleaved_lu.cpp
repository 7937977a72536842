#include "core/linear/interleaved_lu.h"

#include <algorithm>

namespace irk {
namespace {

constexpr std::size_t kMaxLanes = 8, kMinWidth = 4;

// Writes the entries of one lane. Each entry holds the real parts of all lanes, then their imaginary parts.
template <class T>
void spread(const std::vector<T>& from, std::size_t lane, std::size_t width, std::vector<double>& to) {
  double* out = to.data() + lane;
  for (const T& x : from) {
    out[0] = std::real(x);
    out[width] = std::imag(x);
    out += 2 * width;
  }
}

template <int kWidth>
struct Pack {
  using Array = Eigen::Array<double, kWidth, 1>;
  using In = Eigen::Map<const Array>;
  using Out = Eigen::Map<Array>;
};

}  // namespace

InterleavedLu::InterleavedLu(const SparseAnalysis& analysis, std::size_t matrices)
    : versions_(matrices), work_(static_cast<std::size_t>(analysis.n()) * 2 * kMaxLanes) {
  const auto n = static_cast<std::size_t>(analysis.n());
  for (std::size_t first = 0; first < matrices; first += kMaxLanes) {
    const std::size_t lanes = std::min(kMaxLanes, matrices - first);
    const std::size_t width = lanes > kMinWidth ? kMaxLanes : kMinWidth, size = 2 * width;
    Group group{first, lanes, width, {}, {}, std::vector<double>(n * size)};
    group.l.reserve(2 * size * analysis.lowerEntries());
    group.u.reserve(2 * size * analysis.upperEntries());
    groups_.push_back(std::move(group));
  }
}

bool InterleavedLu::assign(std::span<const SparseLu<double>> real,
                           std::span<const SparseLu<std::complex<double>>> complex) {
  bool changed = false;
  std::size_t at = 0;
  const auto look = [&](const auto& lu) {
    changed = changed || versions_[at] != lu.version();
    versions_[at++] = lu.version();
  };
  std::for_each(real.begin(), real.end(), look);
  std::for_each(complex.begin(), complex.end(), look);
  if (changed) {
    pivots_ = real.empty() ? &complex.front().pivots() : &real.front().pivots();
    const auto same = [this](const auto& lu) { return lu.pivots() == *pivots_; };
    shared_ = std::all_of(real.begin(), real.end(), same) && std::all_of(complex.begin(), complex.end(), same);
    for (Group& group : groups_) {
      detail::fit(group.l, pivots_->l_row.size() * 2 * group.width);
      detail::fit(group.u, pivots_->u_row.size() * 2 * group.width);
    }
  }
  if (!shared_) return false;
  for (Group& group : groups_) {
    for (std::size_t lane = 0; lane < group.lanes; ++lane) {
      const auto take = [&](const auto& lu) {
        spread(lu.lower(), lane, group.width, group.l);
        spread(lu.upper(), lane, group.width, group.u);
        spread(lu.inverseDiagonal(), lane, group.width, group.inverse_diagonal);
      };
      const std::size_t matrix = group.first + lane;
      if (matrix < real.size()) {
        take(real[matrix]);
      } else {
        take(complex[matrix - real.size()]);
      }
    }
  }
  return true;
}

void InterleavedLu::solve(std::span<const Lane> lanes) {
  for (const Group& group : groups_) {
    const auto own = lanes.subspan(group.first, group.lanes);
    if (group.width == kMinWidth) {
      solveGroup<kMinWidth>(group, own);
    } else {
      solveGroup<kMaxLanes>(group, own);
    }
  }
}

template <int kWidth>
void InterleavedLu::solveGroup(const Group& group, std::span<const Lane> lanes) {
  using Array = typename Pack<kWidth>::Array;
  using In = typename Pack<kWidth>::In;
  using Out = typename Pack<kWidth>::Out;
  const SparsePivots& f = *pivots_;
  const std::size_t n = f.p.size();
  constexpr std::size_t kSize = 2 * kWidth;
  double* const x = work_.data();
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
