#include "core/ensemble/lane_norm.h"

#include "core/ensemble/lane_matrix.h"

namespace irk {
LaneNorm::LaneNorm(const Sizes& sizes, const ErrorPowers& powers, const Tolerances& tolerances)
    : sizes_(sizes),
      powers_(powers),
      tolerances_(tolerances),
      atol_(count(sizes.components()), tolerances.atol),
      inverse_(atol_.size()),
      squares_(count(sizes.n())) {}

void LaneNorm::setScale(std::size_t i, const Vec<double>& scale) {
  for (std::size_t k = 0; k < atol_.size(); ++k) {
    atol_[k].set(i, tolerances_.atol * (scale.size() == 0 ? 1 : scale[static_cast<Index>(k)]));
  }
}

void LaneNorm::update(const LaneState& from, const Lanes& h) {
  const std::size_t nu = count(sizes_.nu), nx = count(sizes_.nx), nz = count(sizes_.nz);
  const std::size_t known = 2 * nu + nx;
  for (std::size_t i = 0; i < known; ++i) inverse_[i] = 1.0 / (atol_[i] + tolerances_.rtol * abs(from.y[i]));
  for (std::size_t i = 0; i < nz; ++i) {
    const Lanes weight = atol_[known + i] + tolerances_.rtol * abs(from.w[nu + nx + i]);
    inverse_[known + i] = powerOf(h, powers_.z[i]) / weight;
  }
  const auto square = [](const Lanes& x) { return x * x; };
  for (std::size_t i = 0; i < nu; ++i) {
    squares_[i] = square(powerOf(h, powers_.v[i] + 1) * inverse_[nu + i]) + square(h * h * inverse_[i]);
  }
  for (std::size_t i = 0; i < nx; ++i) squares_[nu + i] = square(powerOf(h, powers_.x[i] + 1) * inverse_[2 * nu + i]);
  for (std::size_t i = 0; i < nz; ++i) squares_[nu + nx + i] = square(inverse_[known + i]);
}

Lanes LaneNorm::magnitude(const Lanes* y, const Lanes* z) const {
  const std::size_t known = inverse_.size() - count(sizes_.nz);
  Lanes sum;
  for (std::size_t i = 0; i < inverse_.size(); ++i) {
    const Lanes e = (i < known ? y[i] : z[i - known]) * inverse_[i];
    sum += e * e;
  }
  return sqrt(sum * (1.0 / static_cast<double>(sizes_.components())));
}

Lanes LaneNorm::increment(const Lanes* dw, Index s) const {
  // The stages' squares are summed first: in a single sum each addition would wait for the one before.
  const std::size_t n = squares_.size();
  Lanes sum;
  for (std::size_t i = 0; i < n; ++i) {
    Lanes square = dw[i] * dw[i];
    for (std::size_t j = 1; j < count(s); ++j) square += dw[i + j * n] * dw[i + j * n];
    sum += squares_[i] * square;
  }
  return sqrt(sum * (1.0 / static_cast<double>(sizes_.components() * s)));
}

}  // namespace irk
