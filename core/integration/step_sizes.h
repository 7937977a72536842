// The sizes of steps that no controller chooses: fixed ones, and the first guess.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/constants.h"
#include "irk/system.h"

namespace irk {

/// Fixed steps: N equal ones if h divides the interval to 1e-9; otherwise a shorter last step.
template <class Real>
struct Grid {
  Real t0, t_end, h;
  double count;
  bool divides;

  Grid(const Real& start, const Real& end, double length, double step)
      : t0(start),
        t_end(end),
        h(step),
        count(std::ceil(length / step * (1 - 1e-9))),
        divides(std::abs(count * step - length) <= 1e-9 * length) {
    if (divides) h = (end - start) / Real(count);
  }
  std::int64_t steps() const { return static_cast<std::int64_t>(count); }
  bool isWhole(std::int64_t i) const { return divides || i + 1 < steps(); }
  Real end(std::int64_t i) const { return i + 1 == steps() ? t_end : Real(t0 + Real(static_cast<double>(i + 1)) * h); }
};

/// The size in which the solution changes by kFirstChange of itself: HW I (II.4), first guess. Infinity where the norm
/// of the solution or of its rates is at most 1e-5, as there, so that the quotient says nothing.
template <class Real>
double sizeByRates(const State<Real>& state) {
  constexpr double kAboutZero = 1e-5;
  const auto size = [](const auto& y) { return static_cast<double>(Real(y.norm())); };
  const double y = size(state.u) + size(state.v) + size(state.x);
  const double dy = size(state.v) + size(state.a()) + size(state.k());
  return y > kAboutZero && dy > kAboutZero ? kFirstChange * y / dy : std::numeric_limits<double>::infinity();
}

}  // namespace irk
