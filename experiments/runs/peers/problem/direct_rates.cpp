#include "experiments/runs/peers/problem/direct_rates.h"

#include <algorithm>

namespace irk {
namespace {

// Numbers between 1/2 and 3/2 without a pattern.
double direction(Index i, std::size_t c) {
  const double number = 0.618033988749895 * static_cast<double>(i + 1) * static_cast<double>(c + 1);
  return 0.5 + number - std::floor(number);
}

}  // namespace

DirectRates::DirectRates(const System<double>& system)
    : system_(system),
      sizes_(system.sizes()),
      rows_(sizes_.nu + sizes_.nx),
      mass_(rows_),
      no_rates_(Vec<double>::Zero(rows_)),
      d_(sizes_.discrete),
      point_{0,
             {nullptr, 0},
             {nullptr, 0},
             {nullptr, 0},
             {no_rates_.data(), sizes_.nu},
             {no_rates_.data() + sizes_.nu, sizes_.nx},
             {nullptr, 0},
             {d_.data(), sizes_.discrete}},
      rates_(rows_),
      residual_(rows_),
      dual_y_(2 * sizes_.nu + sizes_.nx),
      dual_w_(rows_),
      dual_d_(sizes_.discrete),
      dual_residual_(rows_) {}

Point<Dual<double>> DirectRates::dualPoint(double t, const double* y) {
  const Index nu = sizes_.nu, nx = sizes_.nx;
  for (Index i = 0; i < dual_y_.size(); ++i) dual_y_[i].value = y[i];
  const Dual<double>* const at = dual_y_.data();
  return {t,
          {at, nu},
          {at + nu, nu},
          {at + 2 * nu, nx},
          {dual_w_.data(), nu},
          {dual_w_.data() + nu, nx},
          {nullptr, 0},
          {dual_d_.data(), sizes_.discrete}};
}

// Multiplies D0 by kChunk vectors at once. The first, of ones, gives the diagonal; with the others the result is the
// diagonal times them only if there is nothing beside it.
bool DirectRates::massNear(double t, const double* y, Vec<double>& mass) {
  const auto point = dualPoint(t, y);
  for (Index i = 0; i < rows_; ++i) {
    for (std::size_t c = 0; c < kChunk; ++c) dual_w_[i].d[c] = c == 0 ? 1 : direction(i, c);
  }
  system_.evaluate(Level::kAcceleration, point, {dual_residual_.data(), rows_});
  bool diagonal = true;
  for (Index i = 0; i < rows_; ++i) {
    const auto& products = dual_residual_[i].d;
    mass[i] = products[0];
    diagonal = diagonal && mass[i] != 0 && std::isfinite(mass[i]);
    for (std::size_t c = 1; c < kChunk; ++c) {
      constexpr double kRoundOff = 4 * std::numeric_limits<double>::epsilon();
      diagonal = diagonal && std::abs(products[c] - mass[i] * direction(i, c)) <= kRoundOff * std::abs(mass[i]);
    }
    dual_w_[i] = Dual<double>(0.0);
  }
  return diagonal;
}

// D0 is compared with its values at a few points nearby, and with other rates. Where this is not enough, a Jacobian's
// check finds it later.
void DirectRates::look(double t, const double* y, const Vec<double>& d) {
  constexpr int kSamples = 3;
  known_ = false;
  if (sizes_.nz > 0) return;
  d_ = d;
  for (Index i = 0; i < d.size(); ++i) dual_d_[i] = Dual<double>(d[i]);
  if (!massNear(t, y, mass_)) return;
  Vec<double> near(dual_y_.size()), other(rows_);
  for (int sample = 1; sample <= kSamples; ++sample) {
    for (Index i = 0; i < near.size(); ++i) {
      near[i] = y[i] + 0.1 * (direction(i, static_cast<std::size_t>(sample)) - 1) * (1 + std::abs(y[i]));
    }
    for (Index i = 0; i < rows_; ++i) dual_w_[i].value = 0.5 + 0.1 * static_cast<double>(i + sample);
    const bool same = massNear(t + 0.1 * sample, near.data(), other) && other == mass_;
    if (!same) return;
  }
  known_ = true;
  is_residual_ = sizes_.nu == 0 && (mass_.array() == -1).all();
}

// Not inline: `evaluate` stays short where this is not needed.
void DirectRates::complete(const double* y, double* f) const {
  std::copy_n(y + sizes_.nu, sizes_.nu, f);
  divide(f + sizes_.nu);
}

void DirectRates::divide(double* rates) const {
  for (Index i = 0; i < rows_; ++i) rates[i] = -rates[i] / mass_[i];
}

bool DirectRates::differentiate(double t, const double* y, double* dfdy, double* dfdt, std::int64_t& evaluations) {
  const Index nu = sizes_.nu, n = dual_y_.size(), end = n + (dfdt ? 1 : 0), chunk = static_cast<Index>(kChunk);
  auto point = dualPoint(t, y);
  const auto variable = [&](Index i) -> Dual<double>& { return i < n ? dual_y_[i] : point.t; };
  bool finite = true;
  for (Index first = dfdy ? 0 : n; first < end; first += chunk) {
    const Index count = std::min(chunk, end - first);
    for (Index c = 0; c < count; ++c) variable(first + c).d[static_cast<std::size_t>(c)] = 1;
    system_.evaluate(Level::kAcceleration, point, {dual_residual_.data(), rows_});
    ++evaluations;
    for (Index c = 0; c < count; ++c) {
      const Index j = first + c;
      double* const column = j < n ? dfdy + j * n : dfdt;
      for (Index i = 0; i < nu; ++i) column[i] = j == nu + i ? 1 : 0;
      double* const rates = column + nu;
      for (Index i = 0; i < rows_; ++i) rates[i] = dual_residual_[i].d[static_cast<std::size_t>(c)];
      if (!is_residual_) divide(rates);
      finite = areFinite(rates, rows_) && finite;
      variable(j).d[static_cast<std::size_t>(c)] = 0;
    }
  }
  for (Index i = 0; i < rows_; ++i) rates_[i] = dual_residual_[i].value;
  pointTo(t, y);
  checkAt();
  return finite;
}

void DirectRates::check(double t, const double* y) {
  pointTo(t, y);
  system_.evaluate(Level::kAcceleration, point_, {rates_.data(), rows_});
  checkAt();
}

// rates_ holds the residual at the point with (a, k) = 0. Whether the (a, k) that follow from it with the D0 that is
// known solve the residual.
void DirectRates::checkAt() {
  if (!is_residual_) divide(rates_.data());
  if (!areFinite(rates_.data(), rows_)) return;
  pointRatesTo(rates_.data());
  system_.evaluate(Level::kAcceleration, point_, {residual_.data(), rows_});
  pointRatesTo(no_rates_.data());
  double size = 1;
  for (Index i = 0; i < rows_; ++i) size = std::max(size, std::abs(rates_[i]));
  constexpr double kHalfOfTheDigits = 1.5e-8;
  for (Index i = 0; i < rows_; ++i) {
    if (std::abs(residual_[i]) > kHalfOfTheDigits * size * std::abs(mass_[i])) known_ = false;
  }
}

}  // namespace irk
