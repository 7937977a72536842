#include "core/event_location.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <boost/math/tools/toms748_solve.hpp>

#include "core/multiprecision.h"

namespace irk {
namespace {

// Of a switching function on the dense output, per root; ten are usual.
constexpr std::uintmax_t kMostEvaluations = 200;
// Re-solved steps per switch; four are usual.
constexpr int kMostSolves = 25;
// The part of the tolerance, times h, that the time of a switch may be off.
constexpr double kTimeTolerance = 1e-5;

template <class Real>
Real epsilon() {
  return Eigen::NumTraits<Real>::epsilon();
}

}  // namespace

template <class Real>
EventLocator<Real>::EventLocator(const System<Real>& system, double tolerance)
    : switches_(system),
      dense_(system.sizes()),
      inside_(system.sizes()),
      due_(system.sizes().switches),
      tolerance_(tolerance) {}

template <class Real>
Location<Real> EventLocator<Real>::locate(StepAttempt<Real>& attempt, const State<Real>& from,
                                          const Real& h, State<Real>& next) {
  Root root;
  const Location<Real> seen = first(attempt, from, next, root);
  if (seen.outcome != Outcome::kSuccess || !root.found) return seen;
  return solveTo(attempt, from, h, next, root);
}

// The first sample at which a switch is due, and the earliest root before it, part by part.
template <class Real>
Location<Real> EventLocator<Real>::first(StepAttempt<Real>& attempt, const State<Real>& from,
                                         const State<Real>& next, Root& root) {
  Location<Real> result;
  const auto pieces = attempt.pieces(from);
  for (std::size_t k = 0; k < pieces.count; ++k) {
    const StepPiece<Real>& piece = pieces.at[k];
    dense_.begin(*piece.from, *piece.stages);
    const State<Real>& end = k + 1 < pieces.count ? *pieces.at[k + 1].from : next;
    for (Index j = 1; j <= kParts; ++j) {
      if (j < kParts) dense_.evaluateInside(j, inside_);
      const SwitchReport report = switches_.evaluate(j < kParts ? inside_ : end);
      if (report.outcome != Outcome::kSuccess) {
        result.outcome = report.outcome;
        result.index = report.index;
        return result;
      }
      if (switches_.due() < 0) continue;
      const Real offset = piece.from->t - from.t;
      due_ = switches_.g();
      for (Index i = 0; i < due_.size(); ++i) {
        if (!(due_[i] > Real(0))) continue;
        const Root found =
            refined(i, Real(j - 1) / Real(kParts), Real(j) / Real(kParts), offset, piece.stages->h);
        if (!root.found || found.step < root.step) root = found;
      }
      return result;
    }
  }
  return result;
}

template <class Real>
Real EventLocator<Real>::value(const Real& theta, Index i) {
  dense_.evaluate(theta, inside_);
  return switches_.evaluate(inside_).outcome == Outcome::kSuccess ? switches_.g()[i] : Real(1);
}

// The root of the dense output: a first guess. `high`: where the switch is due.
template <class Real>
auto EventLocator<Real>::refined(Index i, Real low, Real high, const Real& offset, const Real& h)
    -> Root {
  const Real width = high - low;
  Real g_low = value(low, i);
  const Real g_high = value(high, i);
  if (g_low == Real(0)) {  // where the step begins on the surface, that is not the root
    low += width / Real(64);
    g_low = value(low, i);
  }
  if (g_low > Real(0)) {
    high = low;
  } else if (g_high > Real(0)) {
    const auto close = [](const Real& a, const Real& b) { return b - a <= Real(4) * epsilon<Real>(); };
    std::uintmax_t most = kMostEvaluations;
    const auto bracket = boost::math::tools::toms748_solve(
        [&](const Real& theta) { return value(theta, i); }, low, high, g_low, g_high, close, most);
    high = bracket.second;
  }
  const Real near = width / Real(64);
  Real slope = (value(high, i) - value(Real(high - near), i)) / (near * h);
  if (!(slope > Real(0))) slope = (g_high - g_low) / (width * h);
  return {true, i, offset + high * h, slope};
}

template <class Real>
Location<Real> EventLocator<Real>::solveTo(StepAttempt<Real>& attempt, const State<Real>& from,
                                           const Real& h, State<Real>& next, const Root& root) {
  using std::abs;
  Location<Real> result;
  const Real scale = abs(from.t) > h ? Real(abs(from.t)) : h;
  const Real resolution =
      Real(4) * epsilon<Real>() * scale + Real(kTimeTolerance * std::min(tolerance_, 1e-3)) * h;
  Real low(0), high = h, step = root.step > resolution ? root.step : resolution;
  if (step > h) step = h;
  Real slope = root.slope, last_step(0), last_g(0);
  result.index = root.index;
  result.resolution = static_cast<double>(resolution);
  for (int solves = 0; solves < kMostSolves; ++solves) {
    const bool settled = high - low <= resolution;
    if (settled || solves + 1 == kMostSolves) step = high;
    result.attempt = attempt.attempt(from, step, next);
    result.outcome = result.attempt.outcome;
    if (result.outcome != Outcome::kSuccess) return result;
    const SwitchReport report = switches_.evaluate(next);
    result.outcome = report.outcome;
    if (result.outcome != Outcome::kSuccess) return result;
    const Index due = switches_.due();
    const bool other = due >= 0 && due != result.index;
    if (other) {  // values and slopes of the function before say nothing about this one
      result.index = due;
      slope = Real(0);
    }
    const Real g = switches_.g()[result.index];
    result.h = step;
    result.found = due >= 0;
    // A root of the dense output alone: the step goes on to its end.
    if (step == h && due < 0) return result;
    if (due >= 0) {
      high = step;
      if (settled || (slope > Real(0) && g <= slope * resolution)) return result;
    } else {
      low = step;
    }
    if (solves > 0 && !other && abs(Real(step - last_step)) > Real(1e-6) * h) {
      slope = (g - last_g) / (step - last_step);
    }
    last_step = step;
    last_g = g;
    Real guess = slope > Real(0) ? Real(step - g / slope + resolution / Real(2)) : low;
    if (!(guess > low && guess < high)) {
      // Just beyond the last sign change where the root is at the edge, else halve.
      const Real nudge = low + Real(2) * resolution;
      guess = solves < 3 && nudge < high && slope > Real(0) && due < 0
                  ? nudge
                  : Real((low + high) / Real(2));
    }
    step = guess;
  }
  return result;
}

template struct Location<double>;
template struct Location<mp50>;
template struct Location<mp100>;
IRK_INSTANTIATE_CLASS(EventLocator)

}  // namespace irk
