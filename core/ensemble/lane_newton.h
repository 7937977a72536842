// Simplified Newton for the stage equations of eight systems (core/newton/simplified_newton.cpp).
#pragma once

#include <array>
#include <vector>

#include "core/ensemble/lane_stages.h"
#include "core/newton/newton_base.h"
#include "irk/outcome.h"

namespace irk {

/// The result of solving the stages of a step, by lanes.
struct LaneSolved {
  LaneMask solved;
  std::array<Outcome, kLanes> outcome{};  ///< of the lanes in `which` that are not solved
  Lanes round_off;                        ///< in tolerances, see NewtonResult
};

/// Each lane has its own Jacobian, factors, contraction and iterations. A lane that has converged or failed keeps its
/// numbers while others go on. Owns scratch.
class LaneNewton {
 public:
  LaneNewton(const Scheme<double>& scheme, const Sizes& sizes, const std::vector<int>& row_powers,
             const IntegratorOptions& options, double mu);

  /// Begins a new system in lane i.
  void restart(std::size_t i);
  /// Forgets the last attempt in these lanes, in which it failed.
  void forget(const LaneMask& which);

  /// The bound for increments after `accepted` accepted steps, in tolerances.
  double kappa(std::int64_t accepted, bool index3) const { return stop_.after(accepted, index3); }

  /// Solves one step of size h from the states `from`, in the lanes of `which`. W holds start values on entry and
  /// solutions on return.
  LaneSolved solve(LaneStages& stages, const LaneNorm& norm, const LaneState& from, const Lanes& h,
                   const LaneMask& which, const Lanes& kappa, std::vector<Lanes>& W, LaneCounters& counters);

  /// The matrix of the error estimate in the lanes of `which`. If it has its own factors and these are new, they count
  /// as one more factorization, as in a single run.
  LaneMatrix& filterMatrix(const LaneMask& which, LaneCounters& counters);

 private:
  struct Context {
    LaneStages& stages;
    const LaneNorm& norm;
    const LaneState& from;
    Lanes h, kappa;
    std::vector<Lanes>& W;
    LaneCounters& counters;
    LaneSolved& result;
  };
  void differentiate(Context& c, const LaneMask& which);
  LaneMask prepare(Context& c, const LaneMask& which);
  void iterate(Context& c, const LaneMask& which);
  Lanes update(Context& c, LaneMask& running);
  LaneMask isRoundOff(Context& c, const LaneMask& which, const Lanes& norm);
  void fail(Context& c, const LaneMask& which, Outcome outcome);

  Index s_;
  IncrementLimit stop_;
  double round_off_, keep_below_;
  int limit_;
  LaneJacobian jacobian_;
  LaneMatrix matrix_;
  LaneMask stale_, differentiated_, factorized_;
  LaneMask new_filter_;           // lanes whose factors no estimate has used yet
  Lanes jacobian_t_, factors_h_;  // time of the Jacobians, step size of the factors
  Lanes eta_;                     // of the last solved step, see SimplifiedNewton
  Lanes theta_;                   // the last contraction
  Lanes slowest_;                 // see SimplifiedNewton
  std::vector<Lanes> W0_, R_, R0_, change_, moved_;
};

}  // namespace irk
