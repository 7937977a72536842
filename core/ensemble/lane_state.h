// States and counters of eight systems side by side.
#pragma once

#include <vector>

#include "core/ensemble/lane_mask.h"
#include "irk/statistics.h"
#include "irk/system.h"

namespace irk {

/// The states between two steps, as in State.
struct LaneState {
  explicit LaneState(const Sizes& n)
      : y(static_cast<std::size_t>(2 * n.nu + n.nx)), w(static_cast<std::size_t>(n.n())), carry(y.size()) {}

  Lanes t;
  std::vector<Lanes> y;  ///< u, v, x
  std::vector<Lanes> w;  ///< a, k, z
  std::vector<Lanes> carry;

  /// Sets lane i.
  void set(std::size_t i, const State<double>& state) {
    t.set(i, state.t);
    std::size_t k = 0;
    for (const auto* part : {&state.u, &state.v, &state.x}) {
      for (const double value : *part) y[k++].set(i, value);
    }
    for (std::size_t j = 0; j < w.size(); ++j) w[j].set(i, state.w[static_cast<Index>(j)]);
    for (std::size_t j = 0; j < carry.size(); ++j) carry[j].set(i, state.carry[static_cast<Index>(j)]);
  }
  /// Lane i.
  State<double> get(std::size_t i, const Sizes& sizes) const {
    State<double> state(sizes);
    state.t = t[i];
    std::size_t k = 0;
    for (auto* part : {&state.u, &state.v, &state.x}) {
      for (double& value : *part) value = y[k++][i];
    }
    for (std::size_t j = 0; j < w.size(); ++j) state.w[static_cast<Index>(j)] = w[j][i];
    for (std::size_t j = 0; j < carry.size(); ++j) state.carry[static_cast<Index>(j)] = carry[j][i];
    return state;
  }
};

/// A number of events per lane.
class LaneCount {
 public:
  void add(const LaneMask& lanes, std::int64_t by = 1) { count_ -= lanes.v * by; }
  std::int64_t take(std::size_t i) {
    const std::int64_t all = count_[i];
    count_[i] = 0;
    return all;
  }

 private:
  LaneMask::Vector count_{};
};

/// Counters of operations inside an attempt; LaneRun counts the others.
struct LaneCounters {
  LaneCount residuals, dual_residuals, jacobians, factorizations, solves, newton_iterations, newton_restarts;

  /// Adds the counts of lane i to `counters` and sets them to 0.
  void moveTo(std::size_t i, Counters& counters) {
    counters.residuals += residuals.take(i);
    counters.dual_residuals += dual_residuals.take(i);
    counters.jacobians += jacobians.take(i);
    counters.factorizations += factorizations.take(i);
    counters.solves += solves.take(i);
    counters.newton_iterations += newton_iterations.take(i);
    counters.newton_restarts += newton_restarts.take(i);
  }
};

}  // namespace irk
