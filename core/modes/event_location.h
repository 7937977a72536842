// `locate`: finds the first switch in a solved step and solves the step again so that it ends there.
#pragma once

#include "core/estimates/step_attempt.h"
#include "core/steps/switch_scan.h"

namespace irk {

template <class Real>
struct Location {
  Outcome outcome = Outcome::kSuccess;
  /// A switch is due at the end of `next`. If false and h is below that of the step, the stages' polynomial shows a
  /// switch that the step solved again does not have; the solution is then known as far as `next`.
  bool found = false;
  Index index = -1;       ///< of the switching function, or of one that is not finite
  Real h{};               ///< size of the step that ends at `next`
  double resolution = 0;  ///< to which the time of the switch can be known
  double time_error = 0;  ///< how late the state is, with the round-off of t, and of the state (two units)
  AttemptResult attempt;  ///< of that step
};

/// The root of the dense output is only of order s. It is corrected by solving the step again with the size that the
/// root gives, until the switching function changes sign within round-off of t (or a small part of the tolerance), or
/// of the function itself divided by its slope. The state that is found lies on the far side, where the switch is due.
/// The shortened step is searched once more for an earlier switch. Owns scratch.
template <class Real>
class EventLocator {
 public:
  /// Keeps references.
  EventLocator(const System<Real>& system, double tolerance);

  /// See SwitchScan.
  void begin(double t, double length, std::int64_t looks) { scan_.begin(t, length, looks); }
  void switched(Index i, const Real& t) { scan_.switched(i, t); }

  /// Call it after a solved step of size h from `from` to `next`. Without a switch nothing changes; otherwise `next`
  /// becomes the end of the shorter step of size Location::h.
  [[nodiscard]] Location<Real> locate(StepAttempt<Real>& attempt, const State<Real>& from, const Real& h,
                                      State<Real>& next);

 private:
  struct Root {
    Index index = -1;
    Real step{};   ///< size of the step that ends at it
    Real high{};   ///< size of a step that ends where the switch is due
    Real slope{};  ///< dg/dt
  };
  bool first(StepAttempt<Real>& attempt, const State<Real>& from, const State<Real>& next,
             typename SwitchScan<Real>::EndSample end, Location<Real>& result, Root& root);
  Root refined(const DueInside<Real>& due, const Real& offset, const Real& h);
  void solveStep(StepAttempt<Real>& attempt, const State<Real>& from, const Real& h, State<Real>& next,
                 Location<Real>& result);
  Location<Real> solveTo(StepAttempt<Real>& attempt, const State<Real>& from, const Real& h, State<Real>& next,
                         const Root& root);
  Real resolution(const State<Real>& from, const Real& h) const;

  SwitchingFunctions<Real> functions_;
  SwitchScan<Real> scan_;
  double tolerance_;
};

}  // namespace irk
