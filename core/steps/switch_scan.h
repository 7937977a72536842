// The switching functions along a solved step: where a switch first becomes due inside it.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/stages/dense_output.h"
#include "core/system/switches.h"

namespace irk {

/// A switch that becomes due inside a step: it is not due at theta = low and due at theta = high. Both are 0 if it is
/// already due at the step's start.
template <class Real>
struct DueInside {
  Index index = -1;  ///< of the switching function
  Real low{}, high{};
};

/// Samples the switching functions at kParts + 1 points of each stretch of a solved step. The samples miss a function
/// that rises above 0 and returns between two of them. Where a parabola through three samples comes close to 0, or
/// where a corner next to an end of the stretch hides a peak, the maximum is therefore searched on the stages'
/// polynomial.
///
/// A step is one stretch, but a switching function may vary faster than the solution: a sensor that is passed, a
/// carrier of pulses, the teeth of an encoder. So a stretch has at most kParts of the points that StepOptions::looks
/// distributes over the whole interval; and it is not longer than the time between the last two switches of one
/// function (or from the start to the first), or the time since. Owns scratch; keeps references.
template <class Real>
class SwitchScan {
 public:
  explicit SwitchScan(const System<Real>& system);

  /// Call it at the start t of an integration over `length` in which so many points are looked at. Before it a step is
  /// one stretch.
  void begin(double t, double length, std::int64_t looks);
  /// Function i has switched at t.
  void switched(Index i, const Real& t);

  /// The switches that become due first, all in one part of the step; empty if there is none. The discrete state is
  /// that of `from`; `end` is the step's end before any switch is carried out. All arguments must outlive the use of
  /// `value`. `report` tells whether a function is not finite. `EndSample::kSkip`: the end is known to be due.
  enum class EndSample { kLookAt, kSkip };
  std::span<const DueInside<Real>> first(const State<Real>& from, const StagePolynomial<Real>& stages,
                                         const State<Real>& end, EndSample end_sample = EndSample::kLookAt);
  const SwitchReport& report() const { return report_; }

  /// Function i on the stages' polynomial of the step scanned last; 1 (due) if it is not finite.
  Real value(const Real& theta, Index i);
  /// The state on the polynomial at theta, with the discrete state of the start.
  const State<Real>& at(const Real& theta);

 private:
  struct LastSwitch {
    double t = 0;                                               ///< the start, before the first one
    double distance = std::numeric_limits<double>::infinity();  ///< from the one before
  };
  Index stretchesIn(double t, double h) const;
  Real place(Index j) const { return (Real(stretch_) + Real(j) / Real(kParts)) / Real(stretches_); }
  Real part(Index j) const { return Real(j) / Real(kParts * stretches_); }
  bool scanStretch(const State<Real>& from, const State<Real>& end, Index last);
  bool sample(Index j, const State<Real>& from, const State<Real>& end);
  void leaveRoundOff(const State<Real>& start);
  void look(Index j, Index last);
  void lookBetween(Index i, Index j, Index last);
  void lookForCorner(Index i, Index end, Index inwards);
  void lookForPeak(Index i, Index left, Index right, const Real& g, const Real& bend);

  SwitchingFunctions<Real> functions_;
  DenseOutput<Real> dense_;
  State<Real> inside_;
  double longest_ = std::numeric_limits<double>::infinity();  // stretch, by the looks
  std::vector<LastSwitch> last_;                              // of each function
  Index stretch_ = 0, stretches_ = 1;                         // of the step
  Mat<Real> g_;                                               // functions x (kParts + 1), of the stretch
  std::vector<DueInside<Real>> due_;
  SwitchReport report_;
};

}  // namespace irk
