// `locate`: the first switch in a solved step, and the step solved again to end there.
#pragma once

#include "core/dense_output.h"
#include "core/step_attempt.h"

namespace irk {

template <class Real>
struct Location {
  Outcome outcome = Outcome::kSuccess;
  bool found = false;
  Index index = -1;       ///< of the switching function, also of one that is not finite
  Real h{};               ///< size of the step that ends at the switch
  double resolution = 0;  ///< how finely its time was looked for
  AttemptResult attempt;  ///< of that step
};

/// The root of the dense output is only of order s; it is corrected by solving the step again with
/// the size that it gives, until the switching function changes sign within round-off of t (or a
/// small part of the tolerance). The state found lies on the far side: its switch is due. Owns
/// scratch.
template <class Real>
class EventLocator {
 public:
  /// Keeps references.
  EventLocator(const System<Real>& system, double tolerance);

  /// After a solved step of size h from `from` to `next`. Without a switch everything stays; with
  /// one, `next` is its state.
  [[nodiscard]] Location<Real> locate(StepAttempt<Real>& attempt, const State<Real>& from,
                                      const Real& h, State<Real>& next);

 private:
  struct Root {
    bool found = false;
    Index index = -1;
    Real step{}, slope{};  // from the step's start; dg/dt
  };
  Location<Real> first(StepAttempt<Real>& attempt, const State<Real>& from, const State<Real>& next,
                       Root& root);
  Real value(const Real& theta, Index i);
  Root refined(Index i, Real low, Real high, const Real& offset, const Real& h);
  Location<Real> solveTo(StepAttempt<Real>& attempt, const State<Real>& from, const Real& h,
                         State<Real>& next, const Root& root);

  Switches<Real> switches_;
  DenseOutput<Real> dense_;
  State<Real> inside_;
  Vec<Real> due_;
  double tolerance_;
};

}  // namespace irk
