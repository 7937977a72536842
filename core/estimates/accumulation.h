// Factors by which error estimates are multiplied before they are compared with the tolerance.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/stages/scheme.h"
#include "irk/options.h"

namespace irk {

/// Whether errors of stiff components decay from step to step: |R(infinity)| < 1. Otherwise they add up.
template <class Real>
bool dampsStiffErrors(const Scheme<Real>& scheme) {
  using std::abs;
  if (!scheme.regular || scheme.first > 0) return false;
  return abs(Real(Real(1) - scheme.d.sum())) < Real(0.99);
}

/// Whether |R(z)| does not exceed 1 far in the left half plane: 1 + z b^T (I - z A)^-1 1 at z = -10^6.
template <class Real>
bool isStableAtInfinity(const Scheme<Real>& scheme) {
  const Real z = Real(-1e6);
  const Index s = scheme.s;
  const Mat<Real> shifted = Mat<Real>::Identity(s, s) - z * scheme.A;
  const Vec<Real> stages = shifted.fullPivLu().solve(Vec<Real>::Ones(s));
  return std::abs(static_cast<double>(Real(Real(1) + z * scheme.b.dot(stages)))) < 1.01;
}

/// Factor of the estimate for stiff components: 1 if they have the order of the others and are damped, else 10. With
/// Gauss, Radau IA and all Lobatto families they have the order of the stages or are not damped, which no estimate of
/// one step shows.
template <class Real>
double stiffCaution(const Scheme<Real>& scheme) {
  constexpr double kCaution = 10;
  const bool as_accurate = scheme.tableau.stage_order >= scheme.s || scheme.s == 1;
  return as_accurate && dampsStiffErrors(scheme) ? 1 : kCaution;
}

/// A factor of the estimate for errors of many steps, which add up. It is `caution` in the first kFree steps and then
/// grows, so that the errors of N steps add up to kFree (1 + log(N / kFree)) tolerances instead of N. It grows only as
/// far as the errors so far require: errors far below the tolerance need no reduction. Steps of a higher order than
/// their estimate need no such factor, since their true error is far below the estimate. The factor is at most kMax and
/// asks for no error below kFinest, where round-off begins.
class Accumulation {
 public:
  Accumulation(double caution, const Tolerances& tolerances)
      : caution_(caution), most_(std::clamp(std::max(tolerances.rtol, tolerances.atol) / kFinest, 1.0, kMax)) {}
  void begin() { *this = Accumulation(caution_, most_); }
  /// The factor after `steps` accepted steps whose estimates add up to `sum`. steps = 0: the factor does not grow.
  double factor(std::int64_t steps, double sum) const {
    const double part = caution_ * sum / kFree;
    const double growth = std::min(static_cast<double>(steps) / kFree, part * part * part);
    return std::min(most_, caution_ * std::max(1.0, growth));
  }
  /// The error that the controller gets for an attempt from t with step h: the estimate `error` times the factor. An
  /// error within the tolerance is accepted if a shorter step from the same t has not reduced it, as with errors of
  /// multipliers and of round-off: still shorter steps would not reduce it either.
  double asked(double error, double factor, double t, double h) {
    double asked = error * factor;
    const bool in_vain = t == t_ && h < h_ && error > error_ * std::sqrt(h / h_);
    if (asked > 1 && error <= 1 && in_vain) asked = 1;
    t_ = t;
    h_ = h;
    error_ = error;
    return asked;
  }

 private:
  Accumulation(double caution, double most) : caution_(caution), most_(most) {}

  static constexpr double kFree = 50, kMax = 300, kFinest = 5e-14;
  double caution_, most_;
  double t_ = 0, h_ = 0, error_ = 0;  // of the last attempt
};

/// A result with a larger error than this, in tolerances, is not called a success. A success should be right to 1000
/// tolerances and 1e-9; the limit is a fifth of that, because a motion usually amplifies errors a few times.
inline double largestError(const Tolerances& tolerances) {
  constexpr double kBar = 200, kRoundOff = 2e-10;  // tolerances; absolute
  return kBar + kRoundOff / std::max(tolerances.rtol, tolerances.atol);
}

/// The sum of the estimated errors of all steps. The result is better than the
/// sum if errors of stiff components decay, and worse if the motion amplifies errors. A result above the limit is not
/// trusted.
class ErrorSum {
 public:
  explicit ErrorSum(const Tolerances& tolerances) : bar_(largestError(tolerances)) {}
  void begin() { sum_ = 0; }
  /// Adds the error of a step, in tolerances.
  void add(double error) { sum_ += error; }
  bool aboveBar() const { return sum_ > bar_; }

 private:
  double bar_, sum_ = 0;
};

}  // namespace irk
