// Exact solutions of scenes that are linear between their switches: matrix exponentials, switches
// located to the last digit. Internal.
#pragma once

#include <functional>
#include <memory>

#include "irk/system.h"

namespace irk {

/// y = (u, v, x, 1), and (sin omega t, cos omega t) where the scene is driven.
template <class Real>
struct PiecewiseLinear {
  std::shared_ptr<const System<Real>> system;  ///< for its switches
  State<Real> start;                           ///< at t = 0
  /// The rows of (v', x') = rates(d) y.
  std::function<Mat<Real>(const Vec<Real>& d)> rates;
  Real omega = 0;  ///< 0: not driven

  /// The state at t >= 0 with w = (a, k) and the discrete state.
  State<Real> operator()(const Real& t) const;
};

}  // namespace irk
