// What changes of the components of a state make of a residual.
#pragma once

#include <random>

#include "irk/system.h"

namespace irk {

/// By row of r(state) the root of the sum of squares of its changes if every component of (u, v, x, w) changes by its
/// weight. Estimated from random directions, always the same; no row is blind to all of them. `at_state` is r(state).
template <class Real, class Residual>
Vec<double> weightedChanges(const State<Real>& state, const State<double>& weights, const Vec<Real>& at_state,
                            const Residual& r) {
  constexpr int kSamples = 8;
  std::minstd_rand random(1);
  std::normal_distribution<double> normal;
  Vec<double> squares = Vec<double>::Zero(at_state.size());
  for (int k = 0; k < kSamples; ++k) {
    State<Real> moved = state;
    const auto move = [&](Vec<Real>& part, const Vec<double>& by) {
      for (Index i = 0; i < part.size(); ++i) part[i] += Real(normal(random) * by[i]);
    };
    move(moved.u, weights.u);
    move(moved.v, weights.v);
    move(moved.x, weights.x);
    move(moved.w, weights.w);
    const Vec<Real> change = r(moved) - at_state;
    squares += change.template cast<double>().cwiseAbs2() / kSamples;
  }
  return squares.cwiseSqrt();
}

}  // namespace irk
