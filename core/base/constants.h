// The numbers that decide: whether an iteration, a step, a switch or a result is accepted, how long a step is, how many
// stages it has, and how a run ends. `irk list constants` prints them. Options and their defaults: irk/options.h.
// Numbers that only choose between algorithms of equal results stand beside these algorithms.
#pragma once

#include <string_view>

namespace irk {

struct Constant {
  double value;
  std::string_view name;     ///< its place: `newton.kappa`
  std::string_view decides;  ///< what, in one line
  std::string_view source;   ///< book and equation, or the measurement, in one line

  constexpr operator double() const { return value; }
  constexpr int whole() const { return static_cast<int>(value); }
};

// Newton's method.
inline constexpr Constant kRoundOffUnits{
    10, "newton.round_off",
    "So many eps are round-off: of an increment in tolerances, of a measured round-off, of a component's scale.",
    "RADAU: FNEWT >= 10 UROUND / RTOL"};
inline constexpr Constant kStagnationUnits{
    1e4, "newton.stagnation",
    "So many eps may be round-off: of increments that no longer contract, of low orders' errors, of time, of a drift.",
    "chosen"};
inline constexpr Constant kLargestRoundOff{
    0.3, "newton.accepted_round_off", "Round-off of up to so many tolerances is accepted, and reported.", "chosen"};
inline constexpr Constant kLastDigits{4, "newton.last_digits",
                                      "To measure round-off, numbers are changed by this many eps.",
                                      "the round-off of a sum of the stages"};
inline constexpr Constant kNewtonPart{0.01, "newton.kappa", "The part of the tolerance that Newton's method may leave.",
                                      "HW II (IV.8.10); on 58 scenes 1e-10 .. 1e-2: cost at equal error as with "
                                      "smaller ones, errors nearer the tolerance"};
inline constexpr Constant kHiddenPart{0.1, "newton.kappa_doubling",
                                      "With estimate 'richardson', and in index 3, this part of it.",
                                      "2^q - 1 divides what Newton leaves in the halves: twice the error without it; 5 "
                                      "of 45 runs of index 3 fail without it"};
inline constexpr Constant kManySteps{1000, "newton.kappa_steps", "From so many steps on, kappa falls as 1 / steps.",
                                     "what is left has one sign in step after step: N kappa tolerances"};
inline constexpr Constant kTrustedIncrement{
    1, "newton.increment", "An increment ends the iteration up to so many tolerances, whatever the contraction.",
    "a contraction of 1e-13 from the step before, or of start values far off, hides errors of 5e4 and 1e6 tolerances"};
inline constexpr Constant kStuck{0.99, "newton.stuck", "An iteration that contracts by no more than this diverges.",
                                 "RADAU: THETA < 0.99"};
inline constexpr Constant kSlowContraction{
    0.5, "newton.slow",
    "From this contraction on increments may be round-off; no order is chosen whose step would contract worse.",
    "chosen; Hairer & Wanner, J. Comput. Appl. Math. 111 (1999), choose orders by it alone"};
inline constexpr Constant kFixedStepFactor{4, "newton.fixed_iterations", "Fixed steps: so many times max_iterations.",
                                           "chosen: a shorter step, which other controls take, is not to be had"};

// Error estimates.
inline constexpr Constant kStagesAtOne{2.51, "order.stages_at_1",
                                       "Variable order begins with so many stages at tolerance 1 ...",
                                       "measured: the best fixed number over the suite's scenes"};
inline constexpr Constant kStagesPerDecade{0.7, "order.stages_per_decade", "... and so many more per decade below it.",
                                           "as order.stages_at_1"};
inline constexpr Constant kMemberStrictness{
    1.25, "order.strictness", "The exponent by which lower members of a family are held to smaller estimates.",
    "measured: with 1 most of the error comes from the steps of low order (kepler, 1e-8: 300 times)"};

// The error bar.
inline constexpr Constant kBarStricter{
    0.1, "bar.tolerance",
    "The second integration has this part of the tolerance; a bar above this part of the motion, and above the inverse "
    "in tolerances, is measured again.",
    "522 successes on foreign systems: 16 errors above their bar; with 10 times the tolerance 25"};
inline constexpr Constant kBarLeast{50, "bar.least", "It is not below so many eps.", "steps end in round-off there"};
inline constexpr Constant kBarOfFixedSteps{1e-10, "bar.fixed", "The tolerance for a run with fixed steps.",
                                           "they have none to start from"};
inline constexpr Constant kBarLooks{1000, "bar.looks", "Points between its stages that are looked at.",
                                    "foreign scenes: 500 leave 2 % of the bars too small, 1000 0.5 %"};
inline constexpr Constant kBarEffort{
    20000, "bar.effort", "Steps times unknowns that the control of components below their tolerance may take.",
    "51 foreign systems, 765 runs: 73 bars are too small without this control, 1 with it, by at most this effort"};
inline constexpr Constant kLargestBar{1000, "bar.inaccurate", "A larger bar, in tolerances, is no success ...",
                                      "the audit's protocol"};
inline constexpr Constant kLargestBarRoundOff{1e-9, "bar.round_off", "... beyond this error, which round-off may have.",
                                              "the audit's protocol"};

// Step size.
inline constexpr Constant kSafety{0.9, "step.safety", "The part of the step that the error, or a switch in it, allows.",
                                  "HW II (IV.8), RADAU"};
inline constexpr Constant kShrinkAtMost{
    0.2, "step.shrink",
    "A step shrinks at most by this factor, but for the first after a restart; the very first is at most this part of "
    "the interval ...",
    "RADAU: 1 / FACL"};
inline constexpr Constant kGrowAtMost{8, "step.grow", "... and grows at most by this one.", "RADAU: 1 / FACR"};
inline constexpr Constant kErrorFloor{0.01, "step.error_floor", "Gustafsson's rule counts no error below this.",
                                      "RADAU: ERRACC"};
inline constexpr Constant kKeepUpTo{
    1.2, "step.keep", "A step that would grow by less keeps its size; a change of order must gain as much ...",
    "RADAU: QUOT2"};
inline constexpr Constant kKeepAtMost{2, "step.keep_at_most",
                                      "... or by less than the factors' cost in steps, up to this.",
                                      "chains of beams, n = 60 to 200: 0.26 to 0.36 of the time with 2 instead of 1.2"};
inline constexpr Constant kBarredSteps{10, "step.barred", "A size at which Newton failed is barred for so many steps.",
                                       "the error estimate does not show such failures"};
inline constexpr Constant kGammaMin{0.9, "step.paper_gamma", "'paper': the least gamma of (6.3).",
                                    "the paper's text breaks off; far below 1 it prevents growth at round-off"};
inline constexpr Constant kFirstChange{0.01, "step.first_change",
                                       "The first step, and after a restart one that follows a failed first step, "
                                       "changes the solution by this part.",
                                       "HW I (II.4)"};
inline constexpr Constant kSmallestStep{16, "step.smallest", "A step has at least so many eps |t|.",
                                        "below, t + c h does not resolve the stages"};
inline constexpr Constant kStallWindow{50000, "step.stall_window", "A run stalls if, judged by so many attempts, ...",
                                       "chosen: transients end sooner"};
inline constexpr Constant kStallFactor{10, "step.stall_factor", "... the rest needs so many times those that are left.",
                                       "it would end at max_steps, much later"};

// Order.
inline constexpr Constant kMinStay{7, "order.stay", "The order is reconsidered after so many steps.",
                                   "chosen: an error below is known only in such steps"};
inline constexpr Constant kUnknownsPerCost{
    16, "order.cost_factors", "The cost of a stage's factors, in stages of an iteration: the unknowns over this ...",
    "measured"};
inline constexpr Constant kCostPerStep{8, "order.cost_step", "... and of a step beside its stages.",
                                       "measured: Jacobian, estimate, control"};

// Switches.
inline constexpr Constant kCorner{0.25, "switch.corner",
                                  "A corner of a switching function: a third difference above this part of the second.",
                                  "a smooth function's is h times smaller"};
inline constexpr Constant kTimeTolerance{1e-5, "switch.time",
                                         "The error of a switch's time, in steps times the tolerance.",
                                         "chosen: far below the error of a step"};
inline constexpr Constant kSwitchRounds{
    20, "switch.rounds",
    "So many switches without time between them, or repetitions of a step in 'iterate', are chattering; after so many "
    "earlier switches found in one step it is tried shorter.",
    "chosen: two are usual, then the modes repeat in a circle"};

// Starts, constraints, ends.
inline constexpr Constant kFollows{
    0.1, "start.follows", "The first step after a restart follows the rates there to this part of their change.",
    "without it a ball stays on a floor of 1e10 N/m in 2 of 96 runs without vector instructions, in 0 with them"};
inline constexpr Constant kEightDigits{1e-7, "start.violation",
                                       "A start, a fixed row or a repeated residual is wrong beyond this part.",
                                       "what is given with eight digits is no mistake"};
inline constexpr Constant kAllowedDrift{10, "drift.tolerances", "So many tolerances of drift are allowed ...",
                                        "3060 runs of mechanisms: none with an error below 30 drifted by more"};
inline constexpr Constant kCoarsestDrift{0.1, "drift.coarsest", "... and at most this part of the state.",
                                         "a state that leaves its constraints grows"};
inline constexpr Constant kNewtonRest{0.125, "singular.rest",
                                      "A step passes a singular position if Newton's rest exceeds this.",
                                      "half of Kantorovich's 1/4; runs that turned there had 0.22 to 0.25"};
inline constexpr Constant kSingularPivot{1e-15, "singular.pivot", "A ratio of pivots below this is zero.",
                                         "round-off leaves about so much of a zero pivot"};

/// All of them.
inline constexpr const Constant* kConstants[] = {
    &kRoundOffUnits,   &kStagnationUnits,  &kLargestRoundOff,
    &kLastDigits,      &kNewtonPart,       &kHiddenPart,
    &kManySteps,       &kTrustedIncrement, &kStuck,
    &kSlowContraction, &kFixedStepFactor,  &kStagesAtOne,
    &kStagesPerDecade, &kMemberStrictness, &kBarStricter,
    &kBarLeast,        &kBarOfFixedSteps,  &kBarLooks,
    &kBarEffort,       &kLargestBar,       &kLargestBarRoundOff,
    &kSafety,          &kShrinkAtMost,     &kGrowAtMost,
    &kErrorFloor,      &kKeepUpTo,         &kKeepAtMost,
    &kBarredSteps,     &kGammaMin,         &kFirstChange,
    &kSmallestStep,    &kStallWindow,      &kStallFactor,
    &kMinStay,         &kUnknownsPerCost,  &kCostPerStep,
    &kCorner,          &kTimeTolerance,    &kSwitchRounds,
    &kFollows,         &kEightDigits,      &kAllowedDrift,
    &kCoarsestDrift,   &kNewtonRest,       &kSingularPivot,
};

}  // namespace irk
