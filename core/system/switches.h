// The discrete state: which switches are due, and doing them.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

#include "irk/outcome.h"
#include "irk/system.h"

namespace irk {

/// Whether u, v, x jump where the scene makes them.
enum class Jumps { kDone, kNone };

struct SwitchReport {
  Outcome outcome = Outcome::kSuccess;  ///< kNotFinite, or kChattering: no mode is valid
  Index count = 0;                      ///< switches done
  Index index = -1;                     ///< of the last one, or the one to blame
};

/// Switches that follow each other without time passing.
class ChatterDetector {
 public:
  /// After an accepted step of a mode that does not locate: true once per run of kRun steps that
  /// all end with a switch.
  bool step(bool switched) {
    steps_ = switched ? steps_ + 1 : 0;
    return steps_ == kRun;
  }
  /// After a switch located at t as finely as `resolution`, in an integration of this length: true
  /// if there is no getting away.
  bool event(double t, double length, double resolution) {
    events_ = t - last_ <= std::max(kNoTime * length, 4 * resolution) ? events_ + 1 : 0;
    last_ = t;
    return events_ == kRun;
  }

 private:
  static constexpr int kRun = 20;
  static constexpr double kNoTime = 1e-12;
  int steps_ = 0, events_ = 0;
  double last_ = -std::numeric_limits<double>::infinity();
};

/// Evaluates and does switches of one system. Owns scratch.
template <class Real>
class Switches {
 public:
  /// Keeps a reference to the system.
  explicit Switches(const System<Real>& system);

  bool none() const { return g_.size() == 0; }
  /// g at a point; kNotFinite with the first index that is.
  SwitchReport evaluate(const Point<Real>& p);
  SwitchReport evaluate(const State<Real>& state) { return evaluate(pointOf(state)); }
  const Vec<Real>& g() const { return g_; }
  /// The first switch due in g(), or -1.
  Index due() const;
  /// Does due switches until none is due; `done` hears each, after it.
  SwitchReport settle(State<Real>& state, Jumps jumps = Jumps::kDone,
                      const std::function<void(Index)>& done = {});
  /// "switching function 'contact'".
  std::string describe(Index i) const;

 private:
  const System<Real>& system_;
  Vec<Real> g_;
};

}  // namespace irk
