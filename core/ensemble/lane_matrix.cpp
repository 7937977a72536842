#include "core/ensemble/lane_matrix.h"

#include <cmath>

#include "core/base/small_size.h"

namespace irk {
namespace {

// An eigenvalue of A from the Schur form and the same one from the eigenbasis differ by round-off.
constexpr double kSameEigenvalue = 1e-12;

}  // namespace

LaneJacobian::LaneJacobian(const Sizes& n)
    : sizes(n), d0(count(n.n() * n.n())), d1(count(n.n() * n.n())), d2(count(n.n() * n.n())) {}

void laneProduct(const Lanes* in, Index rows, Index leading, const Mat<double>& C, Lanes* out) {
  const Index columns = C.cols();
  withSize<5>(C.rows(), [&](auto s) {
    for (Index j = 0; j < columns; ++j) {
      const double* const c = C.data() + j * s;
      for (Index i = 0; i < rows; ++i) {
        Lanes sum = c[0] * in[i];
        for (Index m = 1; m < s; ++m) sum += c[m] * in[i + m * leading];
        out[i + j * rows] = sum;
      }
    }
  });
}

LaneMatrix::LaneMatrix(const Sizes& sizes, const std::vector<int>& row_powers, const Mat<double>& A, double filter)
    : n_(sizes.n()),
      s_(A.rows()),
      row_powers_(row_powers),
      filter_mu_(filter),
      own_filter_(true),
      y_(count(n_ * s_)),
      eta_(count(n_)) {
  const auto kept = eigenForm(A);
  const BlockForm<double>& form = *kept;
  to_basis_ = form.Q_inverse.transpose();
  from_basis_ = form.Q.transpose();
  filter_ = 0;
  for (const auto& block : form.blocks) {
    const bool pair = block.size == 2;
    blocks_.push_back({block.start, block.mu, pair ? complex_.size() : real_.size(), pair});
    if (pair) {
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

// Calls set(i, j, re, im) for the entries of D0 + m D1 + m^2 D2, m = h mu.
template <class Set>
void LaneMatrix::fill(const LaneJacobian& D, const Lanes& h, const std::complex<double>& mu, const Set& set) const {
  const Lanes re = h * mu.real(), im = h * mu.imag();
  const Lanes re2 = re * re - im * im, im2 = 2.0 * (re * im);
  const Index rates = D.sizes.nu + D.sizes.nx;
  const Lanes once = 1.0 / h;
  for (Index j = 0; j < n_; ++j) {
    for (Index i = 0; i < n_; ++i) {
      const auto k = count(i + j * n_);
      Lanes x = D.d0[k], y = 0.0;
      if (j < rates) x += re * D.d1[k], y += im * D.d1[k];
      if (j < D.sizes.nu) x += re2 * D.d2[k], y += im2 * D.d2[k];
      const int power = row_powers_[count(i)];
      if (power > 0) {
        const Lanes scale = powerOf(once, power);
        x *= scale;
        y *= scale;
      }
      set(i, j, x, y);
    }
  }
}

LaneFactors LaneMatrix::factorize(const LaneJacobian& D, const Lanes& h, const LaneMask& which) {
  LaneFactors all;
  const auto add = [&](auto& lu) {
    const LaneFactors one = lu.factorize(which);
    all.singular = all.singular | one.singular;
    all.not_finite = all.not_finite | one.not_finite;
  };
  const auto real = [&](LaneLu<Lanes>& lu, double mu) {
    fill(D, h, mu, [&](Index i, Index j, const Lanes& x, const Lanes&) { lu.at(i, j) = x; });
    add(lu);
  };
  for (const Block& block : blocks_) {
    if (!block.pair) {
      real(real_[block.lu], block.mu.real());
      continue;
    }
    auto& lu = complex_[block.lu];
    fill(D, h, block.mu, [&](Index i, Index j, const Lanes& x, const Lanes& y) { lu.at(i, j) = {x, y}; });
    add(lu);
  }
  if (own_filter_) real(real_[filter_], filter_mu_);
  return all;
}

void LaneMatrix::solve(Lanes* r) {
  laneProduct(r, n_, n_, to_basis_, y_.data());
  for (const Block& block : blocks_) {
    Lanes* const y = y_.data() + block.start * n_;
    if (!block.pair) {
      real_[block.lu].solve(y);
      continue;
    }
    for (Index i = 0; i < n_; ++i) eta_[count(i)] = {y[i], y[n_ + i]};
    complex_[block.lu].solve(eta_.data());
    for (Index i = 0; i < n_; ++i) y[i] = eta_[count(i)].re, y[n_ + i] = eta_[count(i)].im;
  }
  laneProduct(y_.data(), n_, n_, from_basis_, r);
}

}  // namespace irk
