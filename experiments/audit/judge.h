// Judges whether the `success` of a run is right. The protocol was fixed before any data were seen:
//
//   error     of a state: the largest |y - ref| / max(|ref|, scale) over the components of u, v and x, with the
//             scene's scale. Errors of multipliers z are reported beside it but not judged.
//   kappa     conditioning: all of u, v, x at the start are perturbed by random signs times 1e-9 max(|y|, scale),
//             twice, and integrated strictly; kappa is the largest difference at t_end, measured as an
//             error, divided by 1e-9. It is infinite if a perturbed run fails or is not finite. If hidden
//             constraints forbid every step from a perturbed start, the whole run is perturbed instead, by
//             integrating with the tolerance 1e-9.
//
//             Since 2026-11-26: where the solution is known in closed form, kappa is the growth of an error of the
//             start through the closed form (conditioning.h), since runs of the judged program share its faults. Where
//             that is not to be had, kappa is not known, and the run is judged without it.
//
//   ill_conditioned   kappa > 1000: an error of one tolerance in the start alone exceeds the bar; or
//                     kappa eps > tolerance: round-off alone does. Set aside, whatever the outcome.
//   failed            the outcome is not success: an honest failure.
//   unjudged          a success whose reference is unknown, or known less accurately than a tenth of the bar.
//   wrong             a success with an error above the bar, 1000 tolerance + 1e-9.
//   right             a success with an error up to the bar.
//
// Reported beside the judgement, since 2026-11-23, and not judged:
//   accumulated       steps max(kappa, 1) tolerance: what errors of one tolerance in each step can add up to. A wrong
//                     success above it has a step whose error was not seen; below it, the method keeps its word in each
//                     step, and nothing but an estimate of the global error could tell.
// Since 2026-11-27, after the draws of that day: a run with norm = absolute has its tolerance in the units of its
// components, whatever their magnitudes, and so has its error: scale is 1. Before, runs of e5 (magnitude 1.7e-24) with
// an error of 1e-11 were called wrong though their tolerance was 1e-2. And a closed form is evaluated in 50 digits
// where the scene has them: in double precision that of sampled_control has errors of 1e-11. Since 2026-11-26:
// successes with an error above the bar among those set aside; successes with an error of the multipliers z, or at one
// of the earlier reference times of the run, above the bar. A closed form that is infinite says that there is no
// solution at this time: each success is wrong. The error bar is judged by thresholds.h.
#pragma once

#include <limits>
#include <span>
#include <string_view>

#include "irk/scalar.h"

namespace irk::audit {

inline constexpr double kPerturbation = 1e-9;
inline constexpr double kLargestKappa = 1000;

enum class Judgement { kRight, kFailed, kWrong, kIllConditioned, kUnjudged };
/// The names of all judgements, in the order of the enum.
std::span<const std::string_view> judgementNames();
std::string_view nameOf(Judgement judgement);

/// The facts on which a judgement is based. NaN: unknown.
struct Evidence {
  bool success = false;
  double tolerance = 0;
  double error = std::numeric_limits<double>::quiet_NaN();
  double accuracy = error;  ///< of the reference, measured as an error
  double kappa = error;     ///< NaN: the run is judged without it
};

/// The bar: larger errors are wrong.
double bar(double tolerance);

Judgement judge(const Evidence& evidence);

/// The error that local errors of one tolerance each can add up to; NaN where kappa is unknown.
double accumulated(double steps, double kappa, double tolerance);

/// The largest |y - reference| / max(|reference|, scale) over the components first <= i < last; missing scales are 1.
/// Components without a reference (NaN) are skipped. Returns infinity if y is not finite, and NaN if no component has
/// a reference. y and reference must have the same size.
double scaledDifference(const Vec<double>& y, const Vec<double>& reference, const Vec<double>& scale, Index first,
                        Index last);

}  // namespace irk::audit
