#include "core/steps/switch_scan.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>

#include "core/base/constants.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

// Next to an end of the step the peak at a corner does not show in the parabola; a probe at this part of the distance
// of samples finds it.
constexpr double kProbe = 1e-3;
// Limits of the search for a maximum: bits of theta, and evaluations.
constexpr int kPeakBits = 20;
constexpr std::uintmax_t kPeakEvaluations = 40;
// Stretches of a step: 1000 samples, the most looks of an integration.
constexpr Index kMostStretches = 125;

}  // namespace

template <class Real>
SwitchScan<Real>::SwitchScan(const System<Real>& system)
    : functions_(system),
      dense_(system.sizes()),
      inside_(system.sizes()),
      last_(static_cast<std::size_t>(system.sizes().switches)),
      g_(system.sizes().switches, kParts + 1) {
  // Up to four entries per switch: due at a sample, at a peak before it, and at a corner at either end.
  due_.reserve(static_cast<std::size_t>(4 * system.sizes().switches));
}

template <class Real>
void SwitchScan<Real>::begin(double t, double length, std::int64_t looks) {
  longest_ = static_cast<double>(kParts) * length / static_cast<double>(looks);
  std::fill(last_.begin(), last_.end(), LastSwitch{.t = t});
}

template <class Real>
void SwitchScan<Real>::switched(Index i, const Real& t) {
  LastSwitch& last = last_[static_cast<std::size_t>(i)];
  last = {static_cast<double>(t), static_cast<double>(t) - last.t};
}

template <class Real>
Index SwitchScan<Real>::stretchesIn(double t, double h) const {
  double longest = longest_;
  for (const LastSwitch& last : last_) longest = std::min(longest, std::max(last.distance, t - last.t));
  if (!(longest > 0)) return kMostStretches;
  return static_cast<Index>(std::clamp(std::ceil(h / longest), 1.0, static_cast<double>(kMostStretches)));
}

template <class Real>
std::span<const DueInside<Real>> SwitchScan<Real>::first(const State<Real>& from, const StagePolynomial<Real>& stages,
                                                         const State<Real>& end, EndSample end_sample) {
  due_.clear();
  report_ = {};
  if (functions_.none()) return due_;
  dense_.begin(from, stages);
  stretches_ = stretchesIn(static_cast<double>(from.t), static_cast<double>(stages.h));
  for (stretch_ = 0; stretch_ < stretches_; ++stretch_) {
    const bool skips = end_sample == EndSample::kSkip && stretch_ + 1 == stretches_;
    if (!scanStretch(from, end, skips ? kParts - 1 : kParts)) break;
  }
  return due_;
}

// False if there is no need to go on: a switch is due, or a function is not finite.
template <class Real>
bool SwitchScan<Real>::scanStretch(const State<Real>& from, const State<Real>& end, Index last) {
  for (Index j = 0; j <= last; ++j) {
    if (j == 0 && stretch_ > 0) {
      g_.col(0) = g_.col(kParts);
    } else if (!sample(j, from, end)) {
      return false;
    }
    look(j, last);
    if (!due_.empty()) return false;
  }
  return true;
}

template <class Real>
bool SwitchScan<Real>::sample(Index j, const State<Real>& from, const State<Real>& end) {
  const bool is_start = j == 0, is_end = j == kParts && stretch_ + 1 == stretches_;
  if (stretches_ > 1 && !is_start && !is_end) {
    dense_.evaluate(place(j), inside_);
  } else if (!is_start && !is_end) {
    dense_.evaluateInside(j, inside_);
  }
  report_ = functions_.evaluate(is_start ? from : is_end ? end : inside_);
  g_.col(j) = functions_.g();
  if (is_start && report_.outcome == Outcome::kSuccess) leaveRoundOff(from);
  return report_.outcome == Outcome::kSuccess;
}

// A step that begins on a surface g_i = 0, as behind a jump to it, has g_i at its round-off, of either sign.
template <class Real>
void SwitchScan<Real>::leaveRoundOff(const State<Real>& start) {
  for (Index i = 0; i < g_.rows(); ++i) {
    if (g_(i, 0) > Real(0) && g_(i, 0) <= functions_.roundOff(start, i)) g_(i, 0) = Real(0);
  }
}

// Adds the switches that are due at sample j, or between samples up to it.
template <class Real>
void SwitchScan<Real>::look(Index j, Index last) {
  for (Index i = 0; i < g_.rows(); ++i) {
    if (g_(i, j) > Real(0)) {
      due_.push_back({i, place(j > 0 ? j - 1 : 0), place(j)});
    }
    lookBetween(i, j, last);
    if (j == 3) lookForCorner(i, 0, 1);
    if (j == last && j > 3) lookForCorner(i, j, -1);
  }
}

template <class Real>
void SwitchScan<Real>::lookBetween(Index i, Index j, Index last) {
  if (j < 2) return;
  const Real left = g_(i, j - 2), middle = g_(i, j - 1), right = g_(i, j);
  const Real bend = 2 * middle - left - right;
  if (!(bend > Real(0))) return;  // no maximum between them
  if (middle >= left && middle >= right) {
    lookForPeak(i, j - 2, j, middle, bend);
  } else if (j == 2 && left > middle && 4 * middle > 3 * left + right) {
    lookForPeak(i, 0, 1, left, bend);
  } else if (j == last && right > middle && 4 * middle > 3 * right + left) {
    lookForPeak(i, j - 1, j, right, bend);
  }
}

template <class Real>
void SwitchScan<Real>::lookForCorner(Index i, Index end, Index inwards) {
  using std::abs;
  const Real g0 = g_(i, end), g1 = g_(i, end + inwards), g2 = g_(i, end + 2 * inwards);
  const Real bend = 2 * g1 - g0 - g2, third = g_(i, end + 3 * inwards) - 3 * g2 + 3 * g1 - g0;
  if (!(bend > Real(0)) || !(g0 > g1) || !(abs(third) > Real(kCorner.value) * bend)) return;
  const Real rise = value(place(end) + Real(kProbe) * part(inwards), i) - g0;
  if (!(g0 + rise / Real(kProbe) > Real(0))) return;
  lookForPeak(i, std::min(end, end + inwards), std::max(end, end + inwards), g0, rise / Real(kProbe));
}

// `bend`: the second difference of the samples, eight times the height of their parabola above the largest one.
template <class Real>
void SwitchScan<Real>::lookForPeak(Index i, Index left, Index right, const Real& g, const Real& bend) {
  if (!(g + bend > Real(0)) || g > Real(0)) return;
  std::uintmax_t most = kPeakEvaluations;
  const auto peak = boost::math::tools::brent_find_minima([&](const Real& theta) { return Real(-value(theta, i)); },
                                                          place(left), place(right), kPeakBits, most);
  if (peak.second < Real(0)) due_.push_back({i, place(left), peak.first});
}

template <class Real>
Real SwitchScan<Real>::value(const Real& theta, Index i) {
  return functions_.evaluate(at(theta)).outcome == Outcome::kSuccess ? functions_.g()[i] : Real(1);
}

template <class Real>
const State<Real>& SwitchScan<Real>::at(const Real& theta) {
  dense_.evaluate(theta, inside_);
  return inside_;
}

template struct DueInside<double>;
template struct DueInside<BigFloat>;
IRK_INSTANTIATE_CLASS(SwitchScan)

}  // namespace irk
