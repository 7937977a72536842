#include "core/modes/event_location.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <boost/math/tools/toms748_solve.hpp>

#include "core/base/constants.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

// Evaluations of a switching function on the dense output, per root; ten are usual.
constexpr std::uintmax_t kMaxEvaluations = 200;
// After so many solves of a step every second one bisects the bracket.
constexpr int kSecants = 8;
// The largest number of solves; further bisections are below round-off.
template <class Real>
int mostSolves() {
  const double bits = -std::log2(static_cast<double>(Real(Eigen::NumTraits<Real>::epsilon())));
  return kSecants + 2 * static_cast<int>(std::ceil(bits));
}

template <class Real>
Real epsilon() {
  return Eigen::NumTraits<Real>::epsilon();
}

}  // namespace

template <class Real>
EventLocator<Real>::EventLocator(const System<Real>& system, double tolerance)
    : functions_(system), scan_(system), tolerance_(tolerance) {}

template <class Real>
Location<Real> EventLocator<Real>::locate(StepAttempt<Real>& attempt, const State<Real>& from, const Real& h,
                                          State<Real>& next) {
  using Scan = SwitchScan<Real>;
  Location<Real> result;
  result.h = h;
  Root root;
  bool seen = first(attempt, from, next, Scan::EndSample::kLookAt, result, root);
  for (int i = 0; seen && i < kSwitchRounds; ++i) {
    result = solveTo(attempt, from, result.h, next, root);
    if (result.outcome != Outcome::kSuccess) return result;
    seen = first(attempt, from, next, result.found ? Scan::EndSample::kSkip : Scan::EndSample::kLookAt, result, root) &&
           root.step + resolution(from, h) < result.h;
  }
  // The switches are too close to be told apart: the step is tried again with a shorter size.
  if (seen) result.outcome = Outcome::kNewtonFailed;
  return result;
}

// Finds the earliest root in the step on the dense output; false if there is none.
template <class Real>
bool EventLocator<Real>::first(StepAttempt<Real>& attempt, const State<Real>& from, const State<Real>& next,
                               typename SwitchScan<Real>::EndSample end, Location<Real>& result, Root& root) {
  const auto pieces = attempt.pieces(from);
  for (std::size_t k = 0; k < pieces.count; ++k) {
    const StepPiece<Real>& piece = pieces.at[k];
    const bool last = k + 1 == pieces.count;
    const auto due = scan_.first(*piece.from, *piece.stages, last ? next : *pieces.at[k + 1].from,
                                 last ? end : SwitchScan<Real>::EndSample::kLookAt);
    if (scan_.report().outcome != Outcome::kSuccess) {
      result.outcome = scan_.report().outcome;
      result.index = scan_.report().index;
      return false;
    }
    const Real offset = piece.from->t - from.t;
    bool found = false;
    for (const auto& candidate : due) {
      const Root one = refined(candidate, offset, piece.stages->h);
      if (!found || one.step < root.step) root = one;
      found = true;
    }
    if (found) return true;
  }
  return false;
}

// The root of the dense output; a first guess of the switch.
template <class Real>
auto EventLocator<Real>::refined(const DueInside<Real>& due, const Real& offset, const Real& h) -> Root {
  const Index i = due.index;
  Real low = due.low, high = due.high;
  const Real width = high - low;
  if (!(width > Real(0))) return {i, offset, offset, Real(0)};
  Real g_low = scan_.value(low, i);
  const Real g_high = scan_.value(high, i);
  if (g_low == Real(0)) {  // the step begins on the surface: that is not the root
    const Real beside = low + width / Real(64);
    g_low = scan_.value(beside, i);
    if (g_low < Real(0)) low = beside;
  }
  if (g_low < Real(0) && g_high > Real(0)) {
    const auto close = [](const Real& a, const Real& b) { return b - a <= Real(4) * epsilon<Real>(); };
    std::uintmax_t most = kMaxEvaluations;
    const auto bracket = boost::math::tools::toms748_solve([&](const Real& theta) { return scan_.value(theta, i); },
                                                           low, high, g_low, g_high, close, most);
    high = bracket.second;
  } else if (!(g_low < Real(0))) {
    high = low;  // on the surface, or beyond it by round-off
  }
  const Real near = width / Real(64);
  const Real before = high - near > Real(0) ? Real(high - near) : Real(0);
  Real slope(0);
  if (high > before) slope = (scan_.value(high, i) - scan_.value(before, i)) / ((high - before) * h);
  if (!(slope > Real(0))) slope = (g_high - g_low) / (width * h);
  return {i, offset + high * h, offset + due.high * h, slope};
}

template <class Real>
Real EventLocator<Real>::resolution(const State<Real>& from, const Real& h) const {
  using std::abs;
  const Real scale = abs(from.t) > h ? Real(abs(from.t)) : h;
  return Real(4) * epsilon<Real>() * scale + Real(kTimeTolerance * std::min(tolerance_, 1e-3)) * h;
}

namespace {

/// The step sizes between which a switch becomes due.
template <class Real>
struct Bracket {
  Real low, high;
  bool due_at_high;  // by a solved step, not only on the dense output
  Real resolution;
};

// The size to solve next: `high`, if the secant lies beyond it and no solved step has confirmed it; else the secant's,
// if it lies in the bracket and this is no bisection; else just beyond `low`, if the root is expected there; else the
// middle. Secants converge within four solves, unless g is far from smooth.
template <class Real>
Real nextSize(const Bracket<Real>& at, const Real& secant, bool beside_low, bool halves) {
  if (!at.due_at_high && secant >= at.high) return at.high;
  if (!halves && secant > at.low && secant < at.high) return secant;
  const Real nudge = at.low + Real(2) * at.resolution;
  return beside_low && nudge < at.high ? nudge : Real((at.low + at.high) / Real(2));
}

// The dense output has a root here, but the solved step has g < 0. If g is nearly zero, the switch lies a little
// further on, and a step that ended here would leave too short a rest: Newton's residual spoils it in index 3
// (Trajectory), round-off in general (LastSteps). Returns the distance beyond the root to try next, after `before` was
// tried in vain; h if there is no switch and the step goes on.
template <class Real>
Real further(const Real& before, const Real& g, const Real& slope, const Real& resolution, const Real& h) {
  if (!(slope > Real(0))) return h;
  const Real beyond = std::max(Real(4) * before, Real(resolution - Real(2) * g / slope));
  return beyond < Real(kNewtonPart.value) * h ? beyond : h;
}

// How late the state is behind the switch: g over its slope, at most the resolution of the search, plus the round-off
// of t.
template <class Real>
Real late(const Real& g, const Real& slope, const Real& resolution, const Real& t) {
  using std::abs;
  return (slope > Real(0) && g > Real(0) ? std::min(Real(g / slope), resolution) : resolution) +
         epsilon<Real>() * abs(t);
}

}  // namespace

// Solves the step of size h and evaluates the switching functions at its end.
template <class Real>
void EventLocator<Real>::solveStep(StepAttempt<Real>& attempt, const State<Real>& from, const Real& h,
                                   State<Real>& next, Location<Real>& result) {
  result.attempt = attempt.attempt(from, h, next);
  result.outcome = result.attempt.outcome;
  if (result.outcome != Outcome::kSuccess) return;
  result.outcome = functions_.evaluate(next).outcome;
  result.h = h;
  result.found = functions_.due() >= 0;
}

template <class Real>
Location<Real> EventLocator<Real>::solveTo(StepAttempt<Real>& attempt, const State<Real>& from, const Real& h,
                                           State<Real>& next, const Root& root) {
  using std::abs;
  Location<Real> result;
  const Real least = this->resolution(from, h);
  Real resolution = least;  // of time, with the round-off of g divided by its slope
  // The switch is due at `high`: at first on the dense output, beyond which nothing is known.
  Real low(0), high = std::min(h, std::max(root.high, resolution));
  Real step = std::min(high, std::max(root.step, resolution));
  bool due_at_high = false;
  Real beyond(0);  // how far beyond the root of the dense output the switch is looked for
  Real slope = root.slope, noise(-1), last_step(0), last_g(0);
  result.index = root.index;
  for (int solves = 0; solves < mostSolves<Real>(); ++solves) {
    const bool settled = high - low <= resolution;
    if (settled) step = high;
    solveStep(attempt, from, step, next, result);
    if (result.outcome != Outcome::kSuccess) return result;
    const Index due = functions_.due();
    const bool other = due >= 0 && due != result.index;
    if (other) {  // values, slopes and round-off of another function do not apply
      result.index = due;
      slope = Real(0);
      noise = Real(-1);
    }
    const Real g = functions_.g()[result.index];
    if (noise < Real(0)) noise = functions_.roundOff(next, result.index);
    if (step == high && due < 0) {
      beyond = further(beyond, g, slope, resolution, h);
      if (!(step + beyond < h)) return result;
      low = last_step = step;
      last_g = g;
      step = high = step + beyond;
      continue;
    }
    if (solves > 0 && !other && abs(Real(step - last_step)) > Real(1e-6) * h) {
      slope = (g - last_g) / (step - last_step);
    }
    const Real round_off = slope > Real(0) ? Real(noise / slope) : Real(0);  // of g, in time
    resolution = least + round_off;
    result.resolution = static_cast<double>(resolution);
    result.time_error = static_cast<double>(Real(late(g, slope, least, next.t) + round_off / Real(2)));
    if (due >= 0) {
      high = step;
      due_at_high = true;
      if (settled || (slope > Real(0) && g <= slope * resolution)) return result;
    } else {
      low = step;
    }
    last_step = step;
    last_g = g;
    const Real secant = slope > Real(0) ? Real(step - g / slope + resolution / Real(2)) : low;
    const bool beside_low = solves < 3 && slope > Real(0) && due < 0;
    const bool halves = due_at_high && solves >= kSecants && solves % 2 == 0;
    step = nextSize<Real>({low, high, due_at_high, resolution}, secant, beside_low, halves);
  }
  // Neither the time nor g is settled: a state somewhere in the bracket is no switch.
  result.outcome = Outcome::kNewtonFailed;
  return result;
}

template struct Location<double>;
template struct Location<BigFloat>;
IRK_INSTANTIATE_CLASS(EventLocator)

}  // namespace irk
