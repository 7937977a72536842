#include "core/ensemble/lane_matrix.h"

#include <algorithm>
#include <cmath>

#include "core/base/small_size.h"

namespace irk {
namespace {

// An eigenvalue of A from the Schur form and the same one from the eigenbasis differ by round-off.
constexpr double kSameEigenvalue = 1e-12;

}  // namespace

LaneJacobian::LaneJacobian(const Sizes& n)
    : sizes(n), d0(count(n.n() * n.n())), d1(count(n.n() * n.n())), d2(count(n.n() * n.n())) {}

LaneMatrix::LaneMatrix(const Sizes& sizes, const std::vector<int>& row_powers, const Mat<double>& A, double filter)
    : n_(sizes.n()),
      s_(A.rows()),
      row_powers_(row_powers),
      scaled_(std::any_of(row_powers.begin(), row_powers.end(), [](int power) { return power > 0; })),
      scales_(count(n_), 1.0),
      filter_mu_(filter),
      own_filter_(true),
      columns_(count(s_)),
      y_(count(n_ * s_)) {
  const auto kept = eigenForm(A);
  const BlockForm<double>& form = *kept;
  to_basis_ = form.Q_inverse.transpose();
  from_basis_ = form.Q.transpose();
  filter_ = 0;
  for (const auto& block : form.blocks) {
    const bool pair = block.size == 2;
    blocks_.push_back({block.start, block.mu, pair ? complex_.size() : real_.size(), pair});
    const Index first = block.start * n_;
    columns_[count(block.start)] = {first, pair ? 2 : 1};
    if (pair) {
      columns_[count(block.start + 1)] = {first + 1, 2};
      complex_.emplace_back(n_);
      // y1 + i sigma y2 diagonalizes the block: sigma moves into the basis.
      to_basis_.col(block.start + 1) *= block.sigma;
      from_basis_.row(block.start + 1) /= block.sigma;
      continue;
    }
    if (std::abs(block.mu.real() - filter) <= kSameEigenvalue * filter) filter_ = real_.size(), own_filter_ = false;
    real_.emplace_back(n_);
  }
  if (!own_filter_) return;
  filter_ = real_.size();
  real_.emplace_back(n_);
}

// Factorizes D0 + m D1 + m^2 D2 with scaled rows, m = h mu. D2 is 0 unless SecondOrder is true.
template <class Value, class SecondOrder>
LaneFactors LaneMatrix::factorize(LaneLu<Value>& lu, const LaneJacobian& D, const Lanes& h,
                                  const std::complex<double>& mu, const LaneMask& which, SecondOrder) const {
  const Lanes re = h * mu.real(), im = h * mu.imag();
  const Lanes re2 = re * re - im * im, im2 = 2.0 * (re * im);
  return lu.factorize(which, [&, n = n_, scaled = scaled_](Index i, Index j) -> Value {
    const auto k = count(i + j * n);
    if constexpr (std::is_same_v<Value, Lanes>) {
      Lanes x = D.d0[k] + re * D.d1[k];
      if constexpr (SecondOrder::value) x += re2 * D.d2[k];
      return scaled ? scales_[count(i)] * x : x;
    } else {
      ComplexLanes x{D.d0[k] + re * D.d1[k], im * D.d1[k]};
      if constexpr (SecondOrder::value) x.re += re2 * D.d2[k], x.im += im2 * D.d2[k];
      if (scaled) x.re *= scales_[count(i)], x.im *= scales_[count(i)];
      return x;
    }
  });
}

LaneFactors LaneMatrix::factorize(const LaneJacobian& D, const Lanes& h, const LaneMask& which) {
  const Lanes once = 1.0 / h;
  for (std::size_t i = 0; scaled_ && i < scales_.size(); ++i) scales_[i] = powerOf(once, row_powers_[i]);
  LaneFactors all;
  const auto add = [&](auto& lu, const std::complex<double>& mu) {
    const LaneFactors one = D.sizes.nu > 0 ? factorize(lu, D, h, mu, which, std::true_type())
                                           : factorize(lu, D, h, mu, which, std::false_type());
    all.singular = all.singular | one.singular;
    all.not_finite = all.not_finite | one.not_finite;
  };
  for (const Block& block : blocks_) {
    if (block.pair) {
      add(complex_[block.lu], block.mu);
    } else {
      add(real_[block.lu], block.mu.real());
    }
  }
  if (own_filter_) add(real_[filter_], filter_mu_);
  return all;
}

void LaneMatrix::solve(Lanes* r) {
  laneProduct(n_, to_basis_, entriesOf(r, n_), [this](Index i, Index j, const Lanes& y) { y_[place(i, j)] = y; });
  for (const Block& block : blocks_) {
    Lanes* const y = y_.data() + block.start * n_;
    if (block.pair) {
      complex_[block.lu].solve(y);
    } else {
      real_[block.lu].solve(y);
    }
  }
  laneProduct(
      n_, from_basis_, [this](Index i, Index m) { return y_[place(i, m)]; },
      [r, n = n_](Index i, Index j, const Lanes& x) { r[i + j * n] = x; });
}

}  // namespace irk
