// The numbers that decide: whether an iteration, a step, a switch or a result is accepted, how long a step is, how many
// stages it has, and how a run ends. `irk list constants` prints them. Options and their defaults: irk/options.h.
// Numbers that only choose between algorithms of equal results stand beside these algorithms.
#pragma once

#include <iterator>
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
    "An increment is round-off below this many eps / tolerance; as many times measured round-off.",
    "RADAU: FNEWT >= 10 UROUND / RTOL"};
inline constexpr Constant kStagnationUnits{
    1e4, "newton.stagnation", "Increments that no longer contract are round-off below this many eps / tolerance.",
    "chosen; the strictness of variable order ends there, too"};
inline constexpr Constant kLargestRoundOff{
    0.3, "newton.accepted_round_off", "Round-off of up to so many tolerances is accepted, and reported.", "chosen"};
inline constexpr Constant kLastDigits{4, "newton.last_digits",
                                      "To measure round-off, numbers are changed by this many eps.",
                                      "the round-off of a sum of the stages"};
inline constexpr Constant kNewtonPart{0.03, "newton.kappa", "The part of the tolerance that Newton's method may leave.",
                                      "HW II (IV.8.10), RADAU"};
inline constexpr Constant kHiddenPart{0.1, "newton.kappa_doubling", "With estimate 'richardson' this part of it.",
                                      "2^q - 1 divides what Newton's method leaves in the two half steps"};
inline constexpr Constant kManySteps{1000, "newton.kappa_steps", "From so many steps on, kappa falls as 1 / steps.",
                                     "what is left has one sign in step after step: N kappa tolerances"};
inline constexpr Constant kTrustedFirst{
    1, "newton.first_increment",
    "The contraction of the step before is trusted up to an increment of so many tolerances.",
    "a box with Stribeck friction: one increment of 1e6 tolerances was accepted"};
inline constexpr Constant kTrustedIncrement{
    10, "newton.later_increment", "A later increment ends the iteration up to so many tolerances.",
    "transamp, radau_ia_20, 1e-2: increments of 3e5 and 28 tolerances, and an error of 5e4"};
inline constexpr Constant kStuck{0.99, "newton.stuck", "An iteration that contracts by no more than this diverges.",
                                 "RADAU: THETA < 0.99"};
inline constexpr Constant kStagnates{0.5, "newton.stagnates",
                                     "Round-off shows where increments fall by no more than this.", "chosen"};
inline constexpr Constant kLost{10, "newton.fixed_lost",
                                "Fixed steps: the iteration ends at increments of so many times the first.",
                                "a shorter step, which other controls take, is not to be had"};
inline constexpr Constant kFixedStepFactor{4, "newton.fixed_iterations", "Fixed steps: so many times max_iterations.",
                                           "as newton.fixed_lost"};
inline constexpr Constant kContracts{0.7, "newton.paper_contraction",
                                     "'modified': an iteration contracts if it leaves at most this part.",
                                     "the paper, (3.4)"};

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
    0.1, "bar.tolerance", "The second integration has this part of the tolerance.",
    "522 successes on foreign systems: 16 errors above their bar; with 10 times it 25"};
inline constexpr Constant kBarLeast{50, "bar.least", "It is not below so many eps.", "steps end in round-off there"};
inline constexpr Constant kBarOfFixedSteps{1e-10, "bar.fixed", "The tolerance for a run with fixed steps.",
                                           "they have none to start from"};
inline constexpr Constant kBarLooks{1000, "bar.looks", "Points between its stages that are looked at.",
                                    "foreign scenes: 500 leave 2 % of the bars too small, 1000 0.5 %"};
inline constexpr Constant kLargestBar{1000, "bar.inaccurate", "A larger bar, in tolerances, is no success ...",
                                      "the audit's protocol"};
inline constexpr Constant kLargestBarRoundOff{1e-9, "bar.round_off", "... beyond this error, which round-off may have.",
                                              "the audit's protocol"};

// Step size.
inline constexpr Constant kSafety{0.9, "step.safety", "The part of the step that the error allows.",
                                  "HW II (IV.8), RADAU"};
inline constexpr Constant kShrinkAtMost{0.2, "step.shrink", "A step shrinks at most by this factor ...",
                                        "RADAU: 1 / FACL"};
inline constexpr Constant kGrowAtMost{8, "step.grow", "... and grows at most by this one.", "RADAU: 1 / FACR"};
inline constexpr Constant kErrorFloor{0.01, "step.error_floor", "Gustafsson's rule counts no error below this.",
                                      "RADAU: ERRACC"};
inline constexpr Constant kKeepUpTo{
    1.2, "step.keep", "A step that would grow by less keeps its size, and its factors ...", "RADAU: QUOT2"};
inline constexpr Constant kKeepAtMost{2, "step.keep_at_most",
                                      "... or by less than the factors' cost in steps, up to this.",
                                      "chains of beams, n = 60 to 200: 0.26 to 0.36 of the time with 2 instead of 1.2"};
inline constexpr Constant kFutile{0.98, "step.futile",
                                  "Smaller steps are futile if the error's root stays above this part ...",
                                  "an error of round-off would shrink the steps without end"};
inline constexpr Constant kFutileSteps{40, "step.futile_steps", "... in so many steps in a row.", "as step.futile"};
inline constexpr Constant kBarredSteps{10, "step.barred", "A size at which Newton failed is barred for so many steps.",
                                       "the error estimate does not show such failures"};
inline constexpr Constant kFarOff{0.1, "step.far_off", "The factor after the second failure before any step.",
                                  "a first guess may be off by orders of magnitude"};
inline constexpr Constant kGammaMin{0.9, "step.paper_gamma", "'paper': the least gamma of (6.3).",
                                    "the paper's text breaks off; far below 1 it prevents growth at round-off"};
inline constexpr Constant kPaperShrinkAtMost{0.05, "step.paper_shrink",
                                             "'paper': a step shrinks at most by this factor.", "the paper gives none"};
inline constexpr Constant kFirstChange{0.01, "step.first_change",
                                       "The first step changes the solution by this part ...", "HW I (II.4)"};
inline constexpr Constant kFirstPart{0.1, "step.first_part", "... and is at most this part of the interval.",
                                     "HW I (II.4)"};
inline constexpr Constant kJustBefore{0.98, "step.before_switch",
                                      "A rejected step over a switch is followed by this part of the way to it.",
                                      "beyond it the step sees both modes"};
inline constexpr Constant kSmallestStep{16, "step.smallest", "A step has at least so many eps |t|.",
                                        "below, t + c h does not resolve the stages"};
inline constexpr Constant kStallWindow{50000, "step.stall_window", "A run stalls if, judged by so many attempts, ...",
                                       "chosen: transients end sooner"};
inline constexpr Constant kStallFactor{10, "step.stall_factor", "... the rest needs so many times those that are left.",
                                       "it would end at max_steps, much later"};

// Order.
inline constexpr Constant kMinStay{7, "order.stay", "The order is reconsidered after so many steps.",
                                   "chosen: an error below is known only in such steps"};
inline constexpr Constant kOrderGain{1.2, "order.gain", "A change must promise so many times the progress.",
                                     "new factors and start values"};
inline constexpr Constant kOrdersAbove{2, "order.above", "So many members above are considered.",
                                       "errors are extrapolated to them"};
inline constexpr Constant kDecayAbove{0.9, "order.decay", "The exponent of the decay of errors that is expected there.",
                                      "less certain than the decay below"};
inline constexpr Constant kFirstStepFailures{12, "order.first_failures",
                                             "So many failures in a first step halve it before the order falls.",
                                             "its size is a guess"};
inline constexpr Constant kLeastContraction{1e-4, "order.least_contraction",
                                            "Newton's contraction counts from this on.", "below, one iteration does"};
inline constexpr Constant kMostContraction{
    0.5, "order.most_contraction", "No order is planned whose step would contract worse.",
    "chosen; Hairer & Wanner, J. Comput. Appl. Math. 111 (1999), decide by it alone"};
inline constexpr Constant kCostPerStage{0.4, "order.cost_stage",
                                        "Cost of a stage beside its iterations, in iterations ...",
                                        "measured: start values and end"};
inline constexpr Constant kUnknownsPerCost{16, "order.cost_factors",
                                           "... of a stage's factors: the unknowns over this ...", "measured"};
inline constexpr Constant kCostPerStep{8, "order.cost_step", "... and of a step.",
                                       "measured: Jacobian, estimate, control"};

// Switches.
inline constexpr Constant kCaution{8, "switch.caution", "The height of a peak between samples counts so many times.",
                                   "the height is at most an eighth of the second difference"};
inline constexpr Constant kCorner{0.25, "switch.corner", "A corner: a third difference above this part of the second.",
                                  "a smooth function's is h times smaller"};
inline constexpr Constant kProbe{1e-3, "switch.probe", "It is probed at this part of the distance of samples.",
                                 "next to an end its peak does not show in the parabola"};
inline constexpr Constant kTimeTolerance{1e-5, "switch.time",
                                         "The error of a switch's time, in steps times the tolerance.",
                                         "chosen: far below the error of a step"};
inline constexpr Constant kNoise{2, "switch.noise",
                                 "The sign of a switching function is known above so many round-offs.",
                                 "one round-off of the value, one of zero"};
inline constexpr Constant kMostSolves{100, "switch.solves", "A switch that is not located by so many solves is none.",
                                      "four are usual; every second one halves from the eighth on: 46 halvings"};
inline constexpr Constant kSwitchRounds{5, "switch.rounds", "So many rounds of switches at one time are carried out.",
                                        "two are usual; then the modes repeat in a circle"};
inline constexpr Constant kModeIterations{10, "switch.iterations", "'iterate': so many repetitions of a step.",
                                          "then no mode is valid over the whole step"};
inline constexpr Constant kChatterRun{20, "switch.chattering", "So many switches in a row are chattering ...",
                                      "chosen: two are usual"};
inline constexpr Constant kNoTime{1e-12, "switch.no_time", "... with less than this part of the interval between them.",
                                  "a contact that accumulates passes through any size"};

// Starts, constraints, ends.
inline constexpr Constant kEightDigits{1e-7, "start.violation",
                                       "A start, a fixed row or a repeated residual is wrong beyond this part.",
                                       "what is given with eight digits is no mistake"};
inline constexpr Constant kAllowedDrift{10, "drift.tolerances", "So many tolerances of drift are allowed ...",
                                        "mechanisms: no result with an error below 30 drifted by more"};
inline constexpr Constant kFinestDrift{1e-12, "drift.finest", "... a tolerance below this counts as this ...",
                                       "round-off"};
inline constexpr Constant kCoarsestDrift{0.1, "drift.coarsest", "... and at most this part of the state.",
                                         "a state that leaves its constraints grows"};
inline constexpr Constant kNewtonRest{0.125, "singular.rest",
                                      "A step passes a singular position if Newton's rest exceeds this.",
                                      "half of Kantorovich's 1/4; runs that turned there had 0.22 to 0.25"};
inline constexpr Constant kNearCosine{0.75, "singular.turn",
                                      "Gradients turn by less than this squared cosine per piece.",
                                      "30 degrees: one piece ends in the arc of 45 in which the rest shows"};
inline constexpr Constant kSingularPivot{1e-15, "singular.pivot", "A ratio of pivots below this is zero.",
                                         "round-off leaves about so much of a zero pivot"};
inline constexpr Constant kZeroUnits{10, "remark.zero", "An amount is zero up to so many eps of its scale.",
                                     "sums of some terms leave that"};

/// All of them.
inline constexpr const Constant* kConstants[] = {&kRoundOffUnits,
                                                 &kStagnationUnits,
                                                 &kLargestRoundOff,
                                                 &kLastDigits,
                                                 &kNewtonPart,
                                                 &kHiddenPart,
                                                 &kManySteps,
                                                 &kTrustedFirst,
                                                 &kTrustedIncrement,
                                                 &kStuck,
                                                 &kStagnates,
                                                 &kLost,
                                                 &kFixedStepFactor,
                                                 &kContracts,
                                                 &kStagesAtOne,
                                                 &kStagesPerDecade,
                                                 &kMemberStrictness,
                                                 &kBarStricter,
                                                 &kBarLeast,
                                                 &kBarOfFixedSteps,
                                                 &kBarLooks,
                                                 &kLargestBar,
                                                 &kLargestBarRoundOff,
                                                 &kSafety,
                                                 &kShrinkAtMost,
                                                 &kGrowAtMost,
                                                 &kErrorFloor,
                                                 &kKeepUpTo,
                                                 &kKeepAtMost,
                                                 &kFutile,
                                                 &kFutileSteps,
                                                 &kBarredSteps,
                                                 &kFarOff,
                                                 &kGammaMin,
                                                 &kPaperShrinkAtMost,
                                                 &kFirstChange,
                                                 &kFirstPart,
                                                 &kJustBefore,
                                                 &kSmallestStep,
                                                 &kStallWindow,
                                                 &kStallFactor,
                                                 &kMinStay,
                                                 &kOrderGain,
                                                 &kOrdersAbove,
                                                 &kDecayAbove,
                                                 &kFirstStepFailures,
                                                 &kLeastContraction,
                                                 &kMostContraction,
                                                 &kCostPerStage,
                                                 &kUnknownsPerCost,
                                                 &kCostPerStep,
                                                 &kCaution,
                                                 &kCorner,
                                                 &kProbe,
                                                 &kTimeTolerance,
                                                 &kNoise,
                                                 &kMostSolves,
                                                 &kSwitchRounds,
                                                 &kModeIterations,
                                                 &kChatterRun,
                                                 &kNoTime,
                                                 &kEightDigits,
                                                 &kAllowedDrift,
                                                 &kFinestDrift,
                                                 &kCoarsestDrift,
                                                 &kNewtonRest,
                                                 &kNearCosine,
                                                 &kSingularPivot,
                                                 &kZeroUnits};

}  // namespace irk
