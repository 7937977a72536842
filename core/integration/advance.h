// What happens when a solved step is taken over: switches, restarts, and what the caller hears.
#pragma once

#include <memory>
#include <string>

#include "core/control/controller.h"
#include "core/derivatives/consistent_start.h"
#include "core/derivatives/projection.h"
#include "core/integration/constraint_check.h"
#include "core/modes/event_location.h"
#include "core/newton/newton_matrix.h"
#include "irk/monitor.h"

namespace irk {

/// The state of an integration. Knows nothing of step sizes. All references outlive it.
template <class Real>
class Advance {
 public:
  Advance(const System<Real>& system, const Scheme<Real>& scheme, const IntegratorOptions& options,
          StepAttempt<Real>& attempt, SharedJacobian<Real>& jacobian, ErrorNorm<Real>& norm,
          StepController* controller, Counters& counters);

  /// A new integration over `length`: due switches, consistent (a, k, z).
  [[nodiscard]] Outcome begin(const State<Real>& start, double length,
                              const Monitor<Real>& monitor);
  /// Takes over `next()`, solved with step h towards `end`. With `locate` the step may be shortened
  /// to the first switch in it. kSuccess, or why the switch cannot be passed; kNewtonFailed and
  /// kSingular: the shortened step could not be solved within the tolerance, and nothing was taken over.
  [[nodiscard]] Outcome accept(const AttemptResult& result, const Real& h, const Real& end);

  const State<Real>& state() const { return state_; }
  State<Real>& next() { return next_; }
  /// What is left to t_end after a switch close to it is no step.
  void endAt(const Real& t_end) { state_.t = t_end; }

  Solution<Real> solution(Outcome outcome, std::string detail) const;
  /// At the end: kSuccess, or kDrift.
  Solution<Real> success();
  Solution<Real> failed(Outcome outcome, double h, const char* what) const;
  /// The switching function that a failure is to be blamed on; -1 for none.
  void blame(Index i) { blamed_ = i; }

 private:
  Outcome settle();
  Outcome restartAtSwitch();
  Outcome acceptLocated(AttemptResult result, Real h, const Real& end);
  void takeOver(const AttemptResult& result, double h);
  void noteChattering(Index i);
  void addNote(const std::string& text);
  void restart();
  void tell(Index i) const;

  const System<Real>& system_;
  ConsistentStart<Real> start_;
  StepAttempt<Real>& attempt_;
  SharedJacobian<Real>& jacobian_;
  StepController* controller_;
  Counters& counters_;
  ErrorNorm<Real>& norm_;
  ConstraintCheck<Real> constraints_;
  /// Index 3: positions and velocities obey their constraints to the error of a step only, of which the short
  /// steps after a restart would make velocities and accelerations. Null in other formulations.
  std::unique_ptr<VelocityProjection<Real>> projection_;
  Switches<Real> switches_;
  EventLocator<Real> locator_;
  bool ends_consistent_;
  bool has_tolerance_;  // no fixed steps
  bool locates_;
  bool switches_now_;  // within the attempts: `ignore` and `iterate`
  ChatterDetector chatter_;
  State<Real> state_, next_;
  const Monitor<Real>* monitor_ = nullptr;
  double length_ = 0;
  std::string start_detail_;  // of a start that is not consistent
  std::string note_;          // of a success
  double round_off_ = 0;      // of Newton, the largest of the accepted steps, in tolerances
  Index blamed_ = -1;
};

}  // namespace irk
