// The discrete state: finds switches that are due, and executes them.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/base/constants.h"
#include "irk/outcome.h"
#include "irk/system.h"

namespace irk {

/// Whether System::jump is called after a switch, so that u, v, x may jump.
enum class Jumps { kDone, kNone };

struct SwitchReport {
  Outcome outcome = Outcome::kSuccess;  ///< or kNotFinite; or kChattering: no mode was found to be valid
  Index count = 0;                      ///< number of switches executed
  Index index = -1;                     ///< of the last switch, or of the switching function that failed
};

/// Detects chattering: switches that follow each other while time (almost) stands still.
class ChatterDetector {
 public:
  /// Call after each accepted step if switches are not located. Returns true when kSwitchRounds steps in succession
  /// have ended with a switch; once for each such sequence.
  bool step(bool switched) {
    steps_ = switched ? steps_ + 1 : 0;
    return steps_ == kSwitchRounds.whole();
  }
  /// Call after a switch located at t, with accuracy `resolution`, in an integration over an interval of this length.
  /// Returns true when kSwitchRounds switches in succession had practically no time between them.
  bool event(double t, double length, double resolution) {
    events_ = t - last_ <= std::max(kStagnationUnits * std::numeric_limits<double>::epsilon() * length, 4 * resolution)
                  ? events_ + 1
                  : 0;
    last_ = t;
    return events_ == kSwitchRounds.whole();
  }

 private:
  int steps_ = 0, events_ = 0;
  double last_ = -std::numeric_limits<double>::infinity();
};

/// The switching functions of one system. Owns scratch.
template <class Real>
class SwitchingFunctions {
 public:
  /// Keeps a reference to the system.
  explicit SwitchingFunctions(const System<Real>& system);

  bool none() const { return g_.size() == 0; }
  /// Evaluates g() at a point. kNotFinite names the first switching function that is not finite.
  SwitchReport evaluate(const Point<Real>& p);
  SwitchReport evaluate(const State<Real>& state) { return evaluate(pointOf(state)); }
  const Vec<Real>& g() const { return g_; }
  /// The first switch that is due by the last g(), or -1.
  Index due() const;
  /// Round-off of function i at `state`, for which g() was evaluated last: the largest change of g_i when all
  /// components of u, v, x, a, k and z change by their last digits, with equal and with alternating signs.
  Real roundOff(const State<Real>& state, Index i);
  /// "switching function 'contact'".
  std::string describe(Index i) const;

 protected:
  const System<Real>& system_;

 private:
  Vec<Real> g_, moved_g_;
  State<Real> moved_;
};

/// Executes the switches of one system. Where a jump sets a component to a surface g_i = 0, g_i behind it is round-off
/// of either sign: a switch that was executed at this time is due again by more than its round-off only.
template <class Real>
class Switches : public SwitchingFunctions<Real> {
 public:
  explicit Switches(const System<Real>& system)
      : SwitchingFunctions<Real>(system), executed_(static_cast<std::size_t>(system.sizes().switches)) {}

  /// Forgets what was executed: for a new integration, and for another attempt of a step.
  void begin() { executed_.assign(executed_.size(), false); }
  /// The first switch that is due at `state`, for which g() was evaluated last, or -1.
  Index dueAt(const State<Real>& state);
  /// Executes due switches, changing state.d (and u, v, x if they jump), until none is due. Calls `done` after each.
  /// After a failure the state keeps the switches executed so far.
  SwitchReport settle(State<Real>& state, Jumps jumps = Jumps::kDone, const std::function<void(Index)>& done = {});

 private:
  Real executed_at_{};          // the time of executed_
  std::vector<bool> executed_;  // which switches were, at that time
};

}  // namespace irk
