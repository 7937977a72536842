// What a solved step misses where no stage looks: the defect of its continuous solution between the stages.
#pragma once

#include <cstdint>
#include <vector>

#include "core/estimates/embedded.h"

namespace irk {

/// Points inside a step that move from step to step, with the weights of a scheme's stages there. Point i is the place
/// (34 i mod 55 + 1/2) / 55 of the step, the golden section's sequence with a period: n successive points leave no gap
/// above 2 / n. Allocates in its constructor.
template <class Real>
class MovingPoints {
 public:
  static constexpr int kPeriod = 55, kStride = 34;  // neighbours among Fibonacci's numbers

  explicit MovingPoints(const Scheme<Real>& scheme);
  static double place(std::int64_t i);

  /// The point i: its place, and the weights of the stages in their polynomial K for (a, k, z), in the integral of K
  /// from the step's start, and in its second integral. Computed at its first use.
  struct Point {
    Real theta;
    ConstVec<Real> inside, once, twice;
  };
  Point operator[](std::int64_t i);

 private:
  const Scheme<Real>& scheme_;
  Mat<Real> inside_, once_, twice_;  // s x kPeriod
  std::vector<bool> known_;
  Vec<Real> p_, integral_, second_;
};

/// The defect of a solved step at t0 + theta h is the residual of its continuous solution: the stages' polynomial K for
/// (a, k, z) and its integrals U, V, X. Weighted and filtered as the embedded estimate is, HW II (IV.8.19):
///   e(theta) = -h mu (D0 + h mu D1 + h^2 mu^2 D2)^-1 r(t0 + theta h; U, V, X; K),  in tolerances.
/// The embedded estimate is e(0). For a smooth solution e(theta) = e(0) omega(theta) / omega(0) with the nodes'
/// polynomial omega, which is largest at theta = 0; so e is below the estimate between the stages. It is above it where
/// the solution has a kink, a jump or a pulse that no stage sees, where the stages are on another root, or where the
/// solution ends. Control of the defect: Enright, ACM TOMS 15 (1989); Shampine, Numer. Math. 101 (2005).
///
/// A step is looked at in one or more moving points (MovingPoints), so that nothing can hide from all steps, and runs
/// repeat bit for bit: in as many as it has hundredths of the whole interval. An input that lasts longer than a
/// fiftieth of the interval cannot be missed. Where the last stage is before the step's end, the end is looked at as
/// well.
///
/// Owns scratch; keeps references.
template <class Real>
class Defect {
 public:
  /// Whether the step's start is looked at: not if an embedded estimate does that anyway.
  enum class Start { kLookAt, kLeaveOut };
  /// `filter` has the step's filter; `scheme` is that of the steps.
  Defect(EmbeddedEstimate<Real>& filter, const Scheme<Real>& scheme, const Sizes& sizes, Start start);

  /// A new integration over this length; its points begin anew.
  void begin(double length);
  /// The number of moving points of a step of size h, in an integration over `length`.
  static int looks(double h, double length);

  using Result = typename EmbeddedEstimate<Real>::Result;
  /// The largest e(theta) of the solved step from `from` to `to`. Counts u, v and x; constraints of index 2 and 3 that
  /// are violated between the stages are no error of the step's end.
  [[nodiscard]] Result largest(const State<Real>& from, const StagePolynomial<Real>& stages, const State<Real>& to);
  /// e(theta) at a point.
  [[nodiscard]] Result at(const typename MovingPoints<Real>::Point& point, const State<Real>& from,
                          const StagePolynomial<Real>& stages);

 private:
  static constexpr double kParts = 100;  // of the interval
  Result atEnd(const State<Real>& end, const Real& t, const Vec<Real>& d, const Vec<Real>& weights,
               const StagePolynomial<Real>& stages);

  EmbeddedEstimate<Real>& filter_;
  const Scheme<Real>& scheme_;
  Sizes sizes_;
  bool looks_at_start_, looks_at_end_;
  double length_ = 0;
  std::int64_t next_ = 0;
  MovingPoints<Real> points_;
  State<Real> at_;
};

}  // namespace irk
