// `locate`: the first switch in a solved step, and the step solved again to end there.
#pragma once

#include "core/estimates/step_attempt.h"
#include "core/steps/switch_scan.h"

namespace irk {

template <class Real>
struct Location {
  Outcome outcome = Outcome::kSuccess;
  /// A switch is due at the end of `next`. False with h below that of the step: the stages'
  /// polynomial shows a switch that the step solved again does not have; `next` is as far as is known.
  bool found = false;
  Index index = -1;       ///< of the switching function, also of one that is not finite
  Real h{};               ///< size of the step that ends at `next`
  double resolution = 0;  ///< how finely its time was looked for
  AttemptResult attempt;  ///< of that step
};

/// The root of the dense output is only of order s; it is corrected by solving the step again with
/// the size that it gives, until the switching function changes sign within round-off of t (or a
/// small part of the tolerance). The state found lies on the far side: its switch is due. The
/// shortened step is looked through once more for an earlier switch. Owns scratch.
template <class Real>
class EventLocator {
 public:
  /// Keeps references.
  EventLocator(const System<Real>& system, double tolerance);

  /// After a solved step of size h from `from` to `next`. Without a switch everything stays; else
  /// `next` is the end of the shorter step of size Location::h.
  [[nodiscard]] Location<Real> locate(StepAttempt<Real>& attempt, const State<Real>& from, const Real& h,
                                      State<Real>& next);

 private:
  struct Root {
    Index index = -1;
    Real step{};   ///< size of the step that ends at it
    Real high{};   ///< and of one that ends where it is due
    Real slope{};  ///< dg/dt
  };
  bool first(StepAttempt<Real>& attempt, const State<Real>& from, const State<Real>& next,
             typename SwitchScan<Real>::EndSample end, Location<Real>& result, Root& root);
  Root refined(const DueInside<Real>& due, const Real& offset, const Real& h);
  Location<Real> solveTo(StepAttempt<Real>& attempt, const State<Real>& from, const Real& h, State<Real>& next,
                         const Root& root);
  Real resolution(const State<Real>& from, const Real& h) const;

  Switches<Real> switches_;
  SwitchScan<Real> scan_;
  double tolerance_;
};

}  // namespace irk
