// C1 functions that replace steps and kinks in regularised scenes. Internal.
#pragma once

namespace irk {

/// A smooth step: 0 for y <= 0, 1 for y >= 1.
template <class T>
T smoothStep(const T& y) {
  if (y <= T(0.0)) return T(0.0);
  if (y >= T(1.0)) return T(1.0);
  return y * y * (3 - 2 * y);
}

/// max(0, y), with its kink rounded for |y| < width.
template <class T, class Real>
T roundedRamp(const T& y, const Real& width) {
  const T above = y + width;
  if (above <= T(0.0)) return T(0.0);
  if (y >= T(width)) return y;
  return above * above / (4 * width);
}

}  // namespace irk
