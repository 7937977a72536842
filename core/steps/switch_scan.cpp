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

template <class Real>
Real partOf(Index j) {
  return Real(j) / Real(kParts);
}

}  // namespace

template <class Real>
SwitchScan<Real>::SwitchScan(const System<Real>& system)
    : switches_(system), dense_(system.sizes()), inside_(system.sizes()), g_(system.sizes().switches, kParts + 1) {
  // Up to four entries per switch: due at a sample, at a peak before it, and at a corner at either end.
  due_.reserve(static_cast<std::size_t>(4 * system.sizes().switches));
}

template <class Real>
std::span<const DueInside<Real>> SwitchScan<Real>::first(const State<Real>& from, const StagePolynomial<Real>& stages,
                                                         const State<Real>& end, EndSample end_sample) {
  due_.clear();
  report_ = {};
  if (switches_.none()) return due_;
  dense_.begin(from, stages);
  const Index last = end_sample == EndSample::kSkip ? kParts - 1 : kParts;
  for (Index j = 0; j <= last; ++j) {
    if (!sample(j, from, end)) return due_;
    look(j, last);
    if (!due_.empty()) return due_;
  }
  return due_;
}

template <class Real>
bool SwitchScan<Real>::sample(Index j, const State<Real>& from, const State<Real>& end) {
  if (j > 0 && j < kParts) dense_.evaluateInside(j, inside_);
  report_ = switches_.evaluate(j == 0 ? from : j == kParts ? end : inside_);
  g_.col(j) = switches_.g();
  return report_.outcome == Outcome::kSuccess;
}

// Adds the switches that are due at sample j, or between samples up to it.
template <class Real>
void SwitchScan<Real>::look(Index j, Index last) {
  for (Index i = 0; i < g_.rows(); ++i) {
    if (g_(i, j) > Real(0)) {
      due_.push_back({i, partOf<Real>(j > 0 ? j - 1 : 0), partOf<Real>(j)});
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
  const Real rise = value(partOf<Real>(end) + Real(kProbe) * partOf<Real>(inwards), i) - g0;
  if (!(g0 + rise / Real(kProbe) > Real(0))) return;
  lookForPeak(i, std::min(end, end + inwards), std::max(end, end + inwards), g0, rise / Real(kProbe));
}

// `bend`: the second difference of the samples, eight times the height of their parabola above the largest one.
template <class Real>
void SwitchScan<Real>::lookForPeak(Index i, Index left, Index right, const Real& g, const Real& bend) {
  if (!(g + bend > Real(0)) || g > Real(0)) return;
  std::uintmax_t most = kPeakEvaluations;
  const auto peak = boost::math::tools::brent_find_minima([&](const Real& theta) { return Real(-value(theta, i)); },
                                                          partOf<Real>(left), partOf<Real>(right), kPeakBits, most);
  if (peak.second < Real(0)) due_.push_back({i, partOf<Real>(left), peak.first});
}

template <class Real>
Real SwitchScan<Real>::value(const Real& theta, Index i) {
  return switches_.evaluate(at(theta)).outcome == Outcome::kSuccess ? switches_.g()[i] : Real(1);
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
