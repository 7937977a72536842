// C1 functions in place of steps and kinks: what the scenes' regularisations are made of. Internal.
#pragma once

namespace irk {

/// From 0 (y <= 0) to 1 (y >= 1).
template <class T>
T smoothStep(const T& y) {
  if (y <= T(0.0)) return T(0.0);
  if (y >= T(1.0)) return T(1.0);
  return y * y * (3 - 2 * y);
}

/// max(0, y), rounded within |y| < width.
template <class T, class Real>
T roundedRamp(const T& y, const Real& width) {
  const T above = y + width;
  if (above <= T(0.0)) return T(0.0);
  if (y >= T(width)) return y;
  return above * above / (4 * width);
}

}  // namespace irk
