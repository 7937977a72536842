// The state of an integration and the next one: tries a step, judges it, and takes it over.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/control/controller.h"
#include "core/derivatives/consistent_start.h"
#include "core/derivatives/projection.h"
#include "core/estimates/inside_attempt.h"
#include "core/estimates/step_attempt.h"
#include "core/integration/amounts.h"
#include "core/integration/singular_positions.h"
#include "core/steps/modes.h"
#include "core/system/switches.h"
#include "irk/monitor.h"

namespace irk {

/// Owns the state, the next state, and the strategies that lead from one to the other. Its caller chooses how far to
/// go. Keeps references to all arguments but `scale`; allocates in its constructor.
template <class Real>
class Trajectory {
 public:
  /// Begins with the member `start` of `schemes`. The options must be legal (core/integration/rules.h).
  Trajectory(const System<Real>& system, const SchemeList<Real>& schemes, std::size_t start,
             const IntegratorOptions& options, const Vec<double>& scale, Counters& counters);

  /// Another scale of the error norm, from the next `begin` on.
  void weighErrorsBy(const Vec<double>& scale) { norm_.setScale(scale); }
  /// Begins a new integration over `length`: carries out due switches and computes consistent (a, k, z).
  [[nodiscard]] Outcome begin(const State<Real>& start, double length, const Monitor<Real>& monitor);

  /// Tries a step of size h. `next()` is then the state at its end; `state()` does not change.
  AttemptResult attempt(const Real& h);
  /// After a failure that a shorter step may avoid: forgets what start values were predicted from, and at the second
  /// failure since the last accepted step solves for the algebraic unknowns of state(); returns the size to try next.
  double shorten(double h);
  /// The controller's decision on the tried step of size h; `resolved`: the size of the shortest step that time
  /// resolves. Must not be called with fixed steps.
  StepDecision decide(const AttemptResult& result, double h, double resolved);
  /// Takes over the tried step of size h, which ends at `end`; a first switch in it shortens it. An outcome other than
  /// kSuccess: the switch cannot be passed. If the outcome isRecoverable, the shortened step could not be solved within
  /// the tolerance, and nothing was taken over.
  [[nodiscard]] Outcome commit(const AttemptResult& result, const Real& h, const Real& end);
  /// After `commit`: the size of the next step if the controller asks for `wanted`. The order may change.
  double nextSize(const AttemptResult& result, double h, double wanted);

  /// Whether `commit` has found a singular position of the constraints in the step; nothing was taken over.
  bool atSingularPosition() const { return positions_ && !positions_->found().empty(); }

  const State<Real>& state() const { return state_; }
  const State<Real>& next() const { return next_; }
  /// Whether no step was accepted since the start or the last restart.
  bool isFirstStep() const { return first_; }
  /// Passes time i of the system's `times`: sets the mode and the state after it and restarts.
  [[nodiscard]] Outcome passTime(Index i);
  /// Sets the time to t_end, after a switch so close to it that the rest is too short for a step.
  void endAt(const Real& t_end) { state_.t = t_end; }

  /// At the end: kSuccess or kDrift.
  Solution<Real> success();
  Solution<Real> failed(Outcome outcome, double h, const std::string& what) const;
  /// For messages that say why steps are small: the rejections, and the component with the largest error.
  std::string rejections() const;

 private:
  /// Makes the algebraic unknowns of the state those that belong to (u, v, x), where they are determined. A step leaves
  /// them with an error, which may be as large as they are; the start values of a short step, taken from them, would
  /// not come nearer to its solution however short it is. Multipliers alone stay: those that belong to errors of stiff
  /// positions are no better start values.
  void solveAlgebraicUnknowns();
  bool isShortAfterLast(const Real& h) const;
  bool satisfyConstraints();
  bool passesSingularPosition();
  Outcome settle();
  /// The end of a step that no switch has ended: carries out the change of mode that the step itself asks for, if any.
  Outcome completeStep();
  Outcome restartAtSwitch();
  void takeOver(const CommittedStep<Real>& step);
  void report(const CommittedStep<Real>& step);
  void followOrder(double error, double h);
  void noteChattering(Index i);
  void addNote(const std::string& text);
  void restart();
  void tell(Index i) const;
  Solution<Real> solution(Outcome outcome, std::string detail) const;

  const System<Real>& system_;
  const IntegratorOptions& options_;
  Counters& counters_;
  ErrorNorm<Real> norm_;
  SharedJacobian<Real> jacobian_;
  std::unique_ptr<StepAttempt<Real>> attempt_;
  int order_;                                   // order of the attempt that the controller has
  std::unique_ptr<StepController> controller_;  // null: fixed steps
  std::unique_ptr<ModesAfterStep<Real>> modes_;
  ConsistentStart<Real> start_;
  Amounts<Real> amounts_;
  /// In index 3 positions and velocities satisfy their constraints only to the error of a step. The short steps after a
  /// restart or a rejection would turn that into errors of velocities and accelerations. Null in other formulations.
  std::unique_ptr<VelocityProjection<Real>> projection_;
  Real last_h_{0};         // size of the last accepted step; 0 if the state was projected since, or is the start
  bool rejected_ = false;  // whether the estimate rejected the last attempt
  std::unique_ptr<SingularPositions<Real>> positions_;  // null without position constraints
  bool leaves_out_ = false;                             // constraints that have to follow from the others
  Switches<Real> switches_;
  ChatterDetector chatter_;
  std::optional<InsideAttempt<Real>> inside_;  // where the monitor asks for it
  State<Real> state_, next_;
  std::optional<State<Real>> earlier_;  // at a switch that the monitor is told of: LocatedSwitch::earlier
  const Monitor<Real>* monitor_ = nullptr;
  double length_ = 0;
  std::string start_detail_;              // why the start is not consistent
  std::string note_;                      // remark on a success
  double round_off_ = 0;                  // of Newton's method; the largest of the accepted steps, in tolerances
  Index blamed_ = -1;                     // the switching function that caused a failure
  const char* last_rejection_ = nullptr;  // cause of the last rejection; null: there was none
  bool determined_ = false;               // at the last start (a, k, z) followed from (u, v, x)
  int failures_ = 0;                      // since the last accepted step
  bool first_ = true;                     // no step was accepted since the start or the last restart
  bool solved_ = false;                   // a step of this integration, with whose error a message may name a component
};

}  // namespace irk
