// What changes of the components of a state make of a residual.
#pragma once

#include <cmath>
#include <limits>
#include <random>

#include "irk/system.h"

namespace irk {

/// By row of r(state) the root of the sum of squares of its changes if every component of (u, v, x, w) changes by its
/// weight. Estimated from random directions, always the same; no row is blind to all of them. `at_state` is r(state).
/// Infinite where a changed state has no finite residual: such a row tells nothing.
template <class Real, class Residual>
Vec<double> weightedChanges(const State<Real>& state, const State<double>& weights, const Vec<Real>& at_state,
                            const Residual& r) {
  constexpr int kSamples = 8;
  std::minstd_rand random(1);
  // Uniform, of variance 1; the library's distributions differ from one to another.
  const auto direction = [&random] {
    const double part = static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max());
    return std::sqrt(3) * (2 * part - 1);
  };
  Vec<double> squares = Vec<double>::Zero(at_state.size());
  for (int k = 0; k < kSamples; ++k) {
    State<Real> moved = state;
    const auto move = [&](Vec<Real>& part, const Vec<double>& by) {
      for (Index i = 0; i < part.size(); ++i) part[i] += Real(direction() * by[i]);
    };
    move(moved.u, weights.u);
    move(moved.v, weights.v);
    move(moved.x, weights.x);
    move(moved.w, weights.w);
    const Vec<Real> there = r(moved);
    for (Index i = 0; i < squares.size(); ++i) {
      const double change = static_cast<double>(Real(there[i] - at_state[i]));
      squares[i] += std::isfinite(change) ? change * change / kSamples : std::numeric_limits<double>::infinity();
    }
  }
  return squares.cwiseSqrt();
}

}  // namespace irk
