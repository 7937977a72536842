// What a solved step misses where no stage looks: the defect of its continuous solution between the stages.
#pragma once

#include <cstdint>
#include <memory>

#include "core/estimates/embedded.h"

namespace irk {

/// Points inside a step that move from step to step, with the weights of a scheme's stages there. Point i is the place
/// (q i mod p + 1/2) / p of the step with neighbours q < p among Fibonacci's numbers, the golden section's sequence
/// with the period p: n <= p successive points leave no gap above 2 / n. The process keeps weights in
/// double.
template <class Real>
class MovingPoints {
 public:
  /// The period is at least `looks`, and 55.
  MovingPoints(const Scheme<Real>& scheme, std::int64_t looks);
  double place(std::int64_t i) const;
  std::int64_t period() const { return period_; }

  /// The points from i on, `most` of them, or fewer at the end of a period: their places, and the weights of the stages
  /// in their polynomial K for (a, k, z), in the integral of K from the step's start, and in its second integral, a
  /// column for each point.
  struct Block {
    Index count;
    const Real* theta;
    Eigen::Map<const Mat<Real>> inside, once, twice;
  };
  Block block(std::int64_t i, std::int64_t most) const;

 private:
  struct Weights {
    Vec<Real> theta;                // period
    Mat<Real> inside, once, twice;  // s x period
  };
  Weights computed(const Scheme<Real>& scheme) const;

  std::int64_t stride_ = 34, period_ = 55;
  std::shared_ptr<const Weights> weights_;
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
/// repeat bit for bit: in its part of StepOptions::looks, rounded up. An input that lasts longer than 2 / looks of the
/// interval cannot be missed. Where the last stage is before the step's end, the end is looked at as well. A step
/// inside an interval that has been looked at, as one that is solved again to its switch, is looked at in one point.
///
/// Owns scratch; keeps references.
template <class Real>
class Defect {
 public:
  /// Whether the step's start is looked at: not if an embedded estimate does that anyway.
  enum class Start { kLookAt, kLeaveOut };
  /// `filter` has the step's filter; `scheme` is that of the steps; `looks`: StepOptions.
  Defect(EmbeddedEstimate<Real>& filter, const Scheme<Real>& scheme, const Sizes& sizes, Start start,
         std::int64_t looks);

  /// A new integration over this length; its points begin anew.
  void begin(double length);
  /// After a restart, or a step whose path was wrong: what was looked at says nothing about the steps that follow.
  void forget() { seen_ = {}; }

  using Result = typename EmbeddedEstimate<Real>::Result;
  /// The largest e(theta) of the solved step from `from` to `to`. Counts u, v and x; constraints of index 2 and 3 that
  /// are violated between the stages are no error of the step's end.
  [[nodiscard]] Result largest(const State<Real>& from, const StagePolynomial<Real>& stages, const State<Real>& to);
  /// e(theta) at the point i alone.
  [[nodiscard]] Result at(std::int64_t i, const State<Real>& from, const StagePolynomial<Real>& stages);

 private:
  static constexpr Index kBlock = 32;  // points that are looked at together
  Result among(std::int64_t first, std::int64_t count, const State<Real>& from, const StagePolynomial<Real>& stages);
  Result atEnd(const State<Real>& end, const Real& t, const Vec<Real>& d, const Vec<Real>& weights,
               const StagePolynomial<Real>& stages);

  EmbeddedEstimate<Real>& filter_;
  const Scheme<Real>& scheme_;
  Sizes sizes_;
  bool looks_at_start_, looks_at_end_;
  double looks_;  // over the interval
  double length_ = 0;
  std::int64_t next_ = 0;
  struct Interval {
    Real first{0}, last{-1};
    bool has(const Real& t) const { return first <= t && t <= last; }
  };
  Interval seen_;  // whose points have been looked at and have shown no error above the tolerance
  MovingPoints<Real> points_;
  Vec<Real> most_;           // the largest residuals of the step's points, n
  Vec<Real> t_;              // times of the points of a block
  Mat<Real> w_, u_, v_, x_;  // the continuous solution there, a column each; w: K
};

/// The number of moving points of a step of size h in an integration over `length`, `looks` in all: at least 1, at most
/// `most`.
std::int64_t looksInStep(double looks, double h, double length, std::int64_t most);

}  // namespace irk
