// Factors by which error estimates are multiplied before they are compared with the tolerance.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/stages/scheme.h"
#include "irk/options.h"

namespace irk {

/// Whether errors of stiff components decay from step to step, |R(infinity)| < 1. Else they add up.
template <class Real>
bool dampsStiffErrors(const Scheme<Real>& scheme) {
  using std::abs;
  if (!scheme.regular || scheme.first > 0) return false;
  return abs(Real(Real(1) - scheme.d.sum())) < Real(0.99);
}

/// 1 where stiff components have the order of the others and are damped. Else (Gauss, Radau IA, all Lobatto
/// families) they have the order of the stages or no damping, which no estimate of one step shows.
template <class Real>
double stiffCaution(const Scheme<Real>& scheme) {
  constexpr double kCaution = 10;
  const bool as_accurate = scheme.tableau.stage_order >= scheme.s || scheme.s == 1;
  return as_accurate && dampsStiffErrors(scheme) ? 1 : kCaution;
}

/// A factor for the errors of many steps, which add up. It is `caution` in the first kFree steps and then grows, so
/// that the errors of N steps add up to kFree (1 + log(N / kFree)) tolerances instead of N. It grows only as far as the
/// errors of the steps so far require: errors far below the tolerance are not made smaller. Steps of a higher order
/// than their estimate need no such factor: their true error is far below the estimate. The factor is at most kMax, and
/// it asks for no error below kFinest, where round-off begins.
class Accumulation {
 public:
  Accumulation(double caution, const Tolerances& tolerances)
      : caution_(caution), most_(std::clamp(std::max(tolerances.rtol, tolerances.atol) / kFinest, 1.0, kMax)) {}
  void begin() { *this = Accumulation(caution_, most_); }
  /// After so many accepted steps with this sum of estimates; 0 steps for estimates that need no more than caution.
  double factor(std::int64_t steps, double sum) const {
    const double part = caution_ * sum / kFree;
    const double growth = std::min(static_cast<double>(steps) / kFree, part * part * part);
    return std::min(most_, caution_ * std::max(1.0, growth));
  }
  /// What the controller is told of an attempt from t with step h: the estimate `error` times the factor. An error
  /// within the tolerance that a shorter step from the same t has not lowered, as of multipliers and of round-off, is
  /// accepted: still shorter steps would not help it either.
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

/// The error of a result, in tolerances, above which it is not called a success. A success should be right to 1000
/// tolerances and 1e-9; the bar is a fifth of that, since a motion amplifies errors a few times as a rule.
inline double largestError(const Tolerances& tolerances) {
  constexpr double kBar = 200, kRoundOff = 2e-10;  // tolerances; absolute
  return kBar + kRoundOff / std::max(tolerances.rtol, tolerances.atol);
}

/// The estimated errors of all steps, added up: where errors of stiff components decay the result is better, where
/// the motion amplifies them it is worse. Above the bar nothing speaks for the result.
class ErrorSum {
 public:
  explicit ErrorSum(const Tolerances& tolerances) : bar_(largestError(tolerances)) {}
  void begin() { sum_ = 0; }
  /// In tolerances.
  void add(double error) { sum_ += error; }
  bool aboveBar() const { return sum_ > bar_; }

 private:
  double bar_, sum_ = 0;
};

}  // namespace irk
