// Exact solutions of scenes that are linear between their switches, by matrix exponentials and by switches that are
// located to the last digit. Internal.
#pragma once

#include <functional>
#include <memory>

#include "irk/problem.h"

namespace irk {

/// The exact solution as a function of time. y = (u, v, x, 1), for a driven scene with (sin omega t, cos omega t)
/// appended.
template <class Real>
struct PiecewiseLinear {
  std::shared_ptr<const System<Real>> system;  ///< defines the switches
  State<Real> start;                           ///< at t = 0
  /// The matrix of (v', x') = rates(d) y.
  std::function<Mat<Real>(const Vec<Real>& d)> rates;
  Real omega = 0;  ///< 0: not driven

  /// The state at t >= 0, with w = (a, k) and the discrete state d.
  State<Real> operator()(const Real& t) const;
};

/// The exact solution of a scene's problem P at t >= 0. P has a function `rates(d)`, and `start` if it does not start
/// from zeros.
template <class Real, class P>
State<Real> exactBetweenSwitches(const P& problem, const Real& t, const Real& omega = 0) {
  const std::shared_ptr<const System<Real>> system = makeSystem<Real>(problem);
  State<Real> start(system->sceneSizes());
  if constexpr (requires { problem.start(start); }) problem.start(start);
  const auto rates = [&problem](const Vec<Real>& d) { return problem.rates(d); };
  return PiecewiseLinear<Real>{system, start, rates, omega}(t);
}

}  // namespace irk
