// Watches an integration for motions below the tolerance, which its error control does not see.
#pragma once

#include <limits>

#include "core/integration/growth.h"
#include "irk/monitor.h"
#include "irk/options.h"

namespace irk {

/// Decides when an integration is looked at: eigenvalues of every state would take longer than its steps.
class LookTimes {
 public:
  /// `length` of the whole interval.
  explicit LookTimes(double length) : length_(length) {}

  /// An integration begins.
  void begin();
  /// A step of size h has come to a state of this speed (Growth::speed).
  void step(double h, double speed);
  /// Whether nothing moved by a tolerance in the last step.
  bool rests() const { return rests_; }
  /// The time for which nothing has moved by a tolerance in a step.
  double restsFor() const { return rests_for_; }
  /// Whether something moves by a tolerance in a twentieth of the interval, or in the last step, of size h.
  bool moves(double h) const;
  /// Whether something moves, but not by a tolerance in a twentieth of the interval. Short steps seem to rest, too.
  bool staysAtRest(double h) const;
  /// Whether the end of the last step, of size h, is to be looked at.
  bool due(double h, Index components);
  /// In so many parts of the time that was not looked at: 1 for the end only.
  int parts() const;
  /// This time, without what came before the rest.
  double unseen() const;
  /// The time since the last look.
  double sinceLook() const { return since_look_; }
  /// A look has found this growth, with steps of size h.
  void looked(double growth, double h) { resolved_ = growth * h > 1 ? 0 : growth; }
  /// The look at the last step is over.
  void lookedAtAll() { since_look_ = 0; }

  /// A twentieth of the interval: so long a time is not passed over while a motion rests.
  double part() const { return length_ / kParts; }

 private:
  static constexpr int kParts = 20;

  double length_;
  bool rests_ = false, comes_to_rest_ = false;
  double rests_for_ = 0, since_look_ = 0;
  Index steps_left_ = 0;  // until the next look
  double resolved_ = 0;   // the growth at the last look, if the steps resolved it; else 0
  double speed_ = 0;      // at the end of the last step
};

/// Watches an integration for motions that rest though errors grow in them: they are nearer to their rest than the
/// tolerance. Such a deviation grows in truth, but a step longer than its time constant damps it: stiffly accurate
/// methods damp all fast motions, growing ones as well. A rest may become unstable after the motion has come to it:
/// what grows then is what the decay has left, so that the decay has to be followed, too, as far as numbers have
/// digits. The integration begins anew when one is found, with steps that are not longer than `limit`.
template <class Real>
class UnstableRest {
 public:
  /// Keeps a reference to the system.
  UnstableRest(const System<Real>& system, const Tolerances& tolerances, const Vec<double>& scale, const Real& t_start,
               const Real& t_end);

  /// Whether it can look at the motion: in the scene's unknowns, and with at most Growth::kMost components.
  bool watches() const { return watches_; }
  /// An integration begins. What was found before is followed.
  void begin();
  /// After each step.
  void look(const StepRecord<Real>& step);
  /// Whether this integration has found one that was not followed. From the next integration on it is.
  bool found() const { return found_; }
  bool follows() const { return follows_ != Follows::kNothing; }
  /// The length of the next step with which a deviation from a rest can be followed.
  double limit() const { return limit_; }
  /// When the rest that was found is unstable.
  double t() const { return t_; }
  /// Whether the deviation has fallen below round-off in a decay, has grown, and has left the rest.
  bool vanished() const { return left_; }
  /// From the next integration on decays are not followed; false if they were not.
  bool leaveDecays();

 private:
  enum class Follows { kNothing, kGrowth, kGrowthAndDecays };

  void judge(const State<Real>& state, double h, double left, double passed);
  void keepAccount(const typename Growth<Real>::Motions& motions, double passed);
  void limitSteps(double growth, double living);

  Growth<Real> growth_;
  LookTimes times_;
  bool watches_;
  Real t_end_;
  Follows follows_ = Follows::kNothing;
  bool leaves_decays_ = false;  // must not follow decays
  double limit_ = std::numeric_limits<double>::infinity(), t_ = 0;
  // Of this integration:
  bool found_ = false;
  bool was_stable_ = false;  // it has come to a rest in which nothing grew
  bool vanished_ = false;    // nothing was left of the motion when it began to grow
  bool left_ = false;        // it has left the rest after that
  double grown_ = 0;         // the exponent by which it has grown since
  State<Real> within_;
};

}  // namespace irk
