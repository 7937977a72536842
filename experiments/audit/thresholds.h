// What is asked of the error bar of a result (irk/error_bar.h), as the audit measures it. These numbers were fixed on
// 2026-11-26, before the first run with an error bar was drawn.
//
// Over all drawn runs, whatever their scene, configuration and treatment of switches, those whose reference is known to
// a tenth of the audit's bar (judge.h):
//
//   coverage      a success is covered if in every component of u, v, x, and of z where its bar is known,
//                   |y - ref| <= 3 (bar + atol scale + rtol |y|) + 1e-12 max(|ref|, scale) + accuracy max(|ref|,
//                   scale),
//                 where accuracy is that of the reference. Runs that are set aside as ill-conditioned count as well: an
//                 error bar is there to say that a motion multiplies errors. Asked: 99.9 % of the successes.
//   sharpness     bar / true error of a success, both the largest |e| / max(|y|, scale) over u, v and x, where the
//                 error is at least 1e-12 and ten accuracies of the reference. Asked: a median of 0.5 to 2 by
//                 configuration and by collection of scenes, and 90 % in 0.1 to 10.
//   cost          CPU time of the integrations that measure over that of the run. Asked: a median of at most 1.3, for
//                 variable order 1.1. Since 2026-11-28 it has the time of the third integration of large bars, and of
//                 a second one with the run's tolerance where the strict one fails.
//   false alarms  runs to the end whose true error in u, v and x is below 100 tolerances and that end as anything but
//                 success, over all runs with such an error. Asked: at most 0.2 %.
//                 Changed on 2026-11-26, after the first draws: a component's tolerance is atol scale + rtol |ref|, as
//                 for the bar itself. Before it was max(rtol, atol) max(|ref|, scale), by which an error of 1800 of the
//                 tolerances that the user had given counted as 6 where rtol was 1000 atol.
//
// Beside it, as the solver's own word, without error bar: successes with an error above 100 and above 1000 tolerances,
// for each integrator of this program and of others.
#pragma once

namespace irk::audit {

inline constexpr double kCoverageAsked = 0.999, kCoverageFactor = 3, kCoverageRoundOff = 1e-12;
inline constexpr double kSharpestMedian = 0.5, kBluntestMedian = 2;
inline constexpr double kSharpAsked = 0.9, kSharpFrom = 0.1, kSharpTo = 10;
inline constexpr double kCostAsked = 1.3, kCostOfVariableAsked = 1.1;
inline constexpr double kFalseAlarmsAllowed = 0.002, kRightTolerances = 100;
inline constexpr double kLargeTolerances = 1000;

}  // namespace irk::audit
