// Whether a run's `success` is right. The protocol, fixed before any data were seen:
//
//   error     of a state: the largest |y - ref| / max(|ref|, scale) over the components of u, v and x, scale the
//             scene's. Multipliers z are reported beside it and judge nothing.
//   kappa     conditioning: all of u, v, x at the start are perturbed by random signs times 1e-9 max(|y|, scale),
//             twice, and integrated strictly; kappa is the largest difference at t_end, measured as an
//             error, over 1e-9. Infinite where a perturbed run fails or is not finite. Where no
//             step leads away from a perturbed start (hidden constraints forbid it) the run is
//             perturbed on its way instead: by the tolerance 1e-9.
//
//   ill_conditioned   kappa > 1000: an error of one tolerance in the start alone passes the bar; or
//                     kappa eps > tolerance: round-off alone does. Set aside, whatever the outcome.
//   failed            the outcome is no success: an honest failure.
//   unjudged          a success, but its reference is unknown, or not known to a tenth of the bar.
//   wrong             a success with an error above the bar, 1000 tolerance + 1e-9.
//   right             a success with an error up to the bar.
#pragma once

#include <limits>
#include <span>
#include <string_view>

#include "irk/scalar.h"

namespace irk::audit {

inline constexpr double kPerturbation = 1e-9;
inline constexpr double kLargestKappa = 1000;

enum class Judgement { kRight, kFailed, kWrong, kIllConditioned, kUnjudged };
/// All of them, in the order of the enum.
std::span<const std::string_view> judgementNames();
std::string_view nameOf(Judgement judgement);

/// What is known about a run. NaN: unknown.
struct Evidence {
  bool success = false;
  double tolerance = 0;
  double error = std::numeric_limits<double>::quiet_NaN();
  double accuracy = error;  ///< of the reference, measured as an error
  double kappa = error;
};

/// Errors above it are wrong.
double bar(double tolerance);

Judgement judge(const Evidence& evidence);

/// Largest |y - reference| / max(|reference|, scale) over the components first <= i < last; missing
/// scales are 1. Components without a reference (NaN) are passed over; infinite where y is not finite;
/// NaN if no component has a reference. y and reference have the same size.
double scaledDifference(const Vec<double>& y, const Vec<double>& reference,
                        const Vec<double>& scale, Index first, Index last);

}  // namespace irk::audit
