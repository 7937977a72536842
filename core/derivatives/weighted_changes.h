// The change of a residual if the components of a state change by their weights.
#pragma once

#include <cmath>
#include <random>

#include "irk/system.h"

namespace irk {

/// For each row of r(state): the root of the sum of squares of its changes if every component of (u, v, x, w) changes
/// by its weight. It is estimated to within a factor of about 2 from eight random directions, always the same; at least
/// one of them changes the row. Directions in which a row is not finite do not count for it; 0 if none is left.
/// `at_state` is r(state).
template <class Real, class Residual>
Vec<double> weightedChanges(const State<Real>& state, const State<double>& weights, const Vec<Real>& at_state,
                            const Residual& r) {
  constexpr int kDirections = 8;
  std::minstd_rand random(1);
  // Numbers of variance 1, away from 0 and of both signs. Not from the standard library: its distributions differ
  // between implementations.
  const auto direction = [&random] {
    const double part = static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max());
    const double even = 2 * part - 1;
    return (even + std::copysign(1.0, even)) / std::sqrt(7.0 / 3);
  };
  Vec<double> root = Vec<double>::Zero(at_state.size());
  Vec<double> finite = root;
  for (int k = 0; k < kDirections; ++k) {
    State<Real> moved = state;
    const auto move = [&](Vec<Real>& part, const Vec<double>& by) {
      for (Index i = 0; i < part.size(); ++i) part[i] += Real(direction() * by[i]);
    };
    move(moved.u, weights.u);
    move(moved.v, weights.v);
    move(moved.x, weights.x);
    move(moved.w, weights.w);
    const Vec<Real> there = r(moved);
    for (Index i = 0; i < root.size(); ++i) {
      const double change = static_cast<double>(Real(there[i] - at_state[i]));
      if (!std::isfinite(change)) continue;
      root[i] = std::hypot(root[i], change);
      ++finite[i];
    }
  }
  return (finite.array() > 0).select(root.array() / finite.array().sqrt(), 0);
}

}  // namespace irk
