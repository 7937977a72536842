// The steps of an integration with fixed steps.
#pragma once

#include <cmath>
#include <cstdint>

#include "irk/scalar.h"

namespace irk {

/// N equal steps if h divides the interval to 1e-9; otherwise a shorter last step.
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

}  // namespace irk
