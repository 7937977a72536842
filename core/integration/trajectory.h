// The state of an integration and the next one: a step is tried, judged, and taken over.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/control/controller.h"
#include "core/derivatives/consistent_start.h"
#include "core/derivatives/projection.h"
#include "core/estimates/step_attempt.h"
#include "core/integration/inside_attempt.h"
#include "core/integration/rest_check.h"
#include "core/integration/stiff_rest.h"
#include "core/steps/modes.h"
#include "core/system/switches.h"
#include "irk/monitor.h"

namespace irk {

/// Owns the state, the next one, and the strategies that lead from one to the other. Chooses no times: its caller says
/// how far to go. Keeps references to all but `scale`; allocates in its constructor.
template <class Real>
class Trajectory {
 public:
  /// Begins with the member `start` of `schemes`; the options are legal (core/integration/rules.h).
  Trajectory(const System<Real>& system, const SchemeList<Real>& schemes, std::size_t start,
             const IntegratorOptions& options, const Vec<double>& scale, Counters& counters);

  /// A new integration over `length`: due switches, consistent (a, k, z).
  [[nodiscard]] Outcome begin(const State<Real>& start, double length, const Monitor<Real>& monitor);

  /// Tries a step of size h: `next()` is where it leads. `state()` stays what it was.
  AttemptResult attempt(const Real& h);
  /// After a failure that a shorter step may avoid: forgets what was predicted from, and returns the size to try next.
  double shorten(double h);
  /// The controller's decision on the tried step of size h; not with fixed steps.
  StepDecision decide(const AttemptResult& result, double h);
  /// Takes over the tried step of size h, which ends at `end`; it may be shortened to the first switch in it. With
  /// another outcome than kSuccess the switch cannot be passed; if it isRecoverable, the shortened step could not be
  /// solved within the tolerance, and nothing was taken over.
  [[nodiscard]] Outcome commit(const AttemptResult& result, const Real& h, const Real& end);
  /// After `commit`: the size of the next step where the controller asks for `wanted`. The order may change.
  double nextSize(const AttemptResult& result, double h, double wanted);

  const State<Real>& state() const { return state_; }
  const State<Real>& next() const { return next_; }
  /// At time i of the system's `times`: the mode after it, and a restart.
  [[nodiscard]] Outcome passTime(Index i);
  /// Sets the time to t_end, after a switch so close to it that the rest is too short for a step.
  void endAt(const Real& t_end) { state_.t = t_end; }

  /// At the end: kSuccess, kDrift or kInaccurate.
  Solution<Real> success();
  Solution<Real> failed(Outcome outcome, double h, const std::string& what) const;
  /// For messages, why steps are small: rejections, and the component with the largest error.
  std::string rejections() const;

 private:
  Outcome settle();
  Outcome restartAtSwitch();
  void takeOver(const CommittedStep<Real>& step);
  void report(const CommittedStep<Real>& step);
  void followOrder(double error, double h);
  void noteChattering(Index i);
  void addNote(const std::string& text);
  void restart();
  void tell(Index i) const;
  std::string undampedRest();
  Solution<Real> solution(Outcome outcome, std::string detail) const;

  const System<Real>& system_;
  const IntegratorOptions& options_;
  Counters& counters_;
  ErrorNorm<Real> norm_;
  SharedJacobian<Real> jacobian_;
  std::unique_ptr<StepAttempt<Real>> attempt_;
  int order_;                                   // of the attempt, as the controller knows it
  std::unique_ptr<StepController> controller_;  // null: fixed steps
  std::unique_ptr<ModesAfterStep<Real>> modes_;
  ConsistentStart<Real> start_;
  RestCheck<Real> rest_;
  /// Index 3: positions and velocities obey their constraints to the error of a step only, of which the short
  /// steps after a restart would make velocities and accelerations. Null in other formulations.
  std::unique_ptr<VelocityProjection<Real>> projection_;
  std::unique_ptr<StiffRest<Real>> stiff_rest_;  // null where such errors decay
  Switches<Real> switches_;
  ChatterDetector chatter_;
  InsideAttempt<Real> inside_;
  State<Real> state_, next_;
  const Monitor<Real>* monitor_ = nullptr;
  double length_ = 0;
  std::string start_detail_;              // of a start that is not consistent
  std::string note_;                      // of a success
  double round_off_ = 0;                  // of Newton, the largest of the accepted steps, in tolerances
  Index blamed_ = -1;                     // the switching function that a failure is to be blamed on
  const char* last_rejection_ = nullptr;  // what rejected a step last; null: none was
};

}  // namespace irk
