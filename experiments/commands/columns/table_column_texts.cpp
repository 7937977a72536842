#include "experiments/commands/columns/column_texts.h"

namespace irk {
namespace {

constexpr ColumnText kBlockText = {"block", "", "The names of the study's blocks that contain it."};
constexpr const char* kSceneTime = "the scene's time unit";

constexpr ColumnText kEnvironments[] = {
    {"environment", "", "Its number: a hash of the other cells but the date."},
    {"commit", "", "The commit from which the program was built."},
    {"version", "", "The program's version."},
    {"host", "", "The machine's name."},
    {"cpu", "", "The processor."},
    {"cores", "", "Processors that the program may use."},
    {"memory_gb", "GiB", "Memory of the machine."},
    {"compiler", "", "Compiler and version."},
    {"flags", "", "Options of the compiler."},
    {"libraries", "", "The operating system, then the libraries with their versions."},
    {"first_date", "", "When it was first used, in UTC."},
};
constexpr ColumnText kCalibrations[] = {
    {"calibration", "", "An id."},
    {"environment", "", "A row of environments.csv."},
    {"date", "", "When it was measured, in UTC."},
    {"calibration_s", "s", "CPU time of the fixed computation, the least of three."},
};
constexpr ColumnText kTimingCores[] = {
    {"trial", "", "An id."},
    {"environment", "", "A row of environments.csv."},
    {"date", "", "When it was made, in UTC."},
    {"cores_at_once", "", "The number of cores on which two fixed computations ran at once."},
    {"elimination_slower", "", "CPU time of the elimination over that on one core alone; nan: not measured."},
    {"vectors_slower", "", "The same for the sum of vectors of 48 MiB."},
    {"taken", "", "1: times were then measured on so many cores at once; 0: not."},
};
constexpr ColumnText kStates[] = {
    {"key", "", "The run: a row of runs.csv."},
    {"state", "those of the components", "u, v, x, z at the end, with blanks between them."},
    {"bar", "those of the components", "The error bar of each; empty: not measured."},
    {"code", "", "As in runs.csv."},
    {"date", "", "As in runs.csv."},
};
constexpr ColumnText kSolution[] = {
    {"t", kSceneTime, "The time, at the end of a step or at one of the --points."},
    {"h", kSceneTime, "The step that ends there, or contains the point; nan at the start."},
    {"error", "tolerances", "The estimated error of the step."},
    {"newton_iterations", "", "Iterations of Newton's method in the step."},
    {"switches", "", "The names of the switches at this time, in the row after them."},
    {"components, outputs", "in the head", "A column for each component of u, v, x, z and each output of the scene."},
};
constexpr ColumnText kTheorySourceText = {
    "source", "",
    "What it rests on: theorem; measured: a pattern found by this suite for up to 5 stages; extrapolated: that pattern "
    "continued."};
constexpr ColumnText kOrders[] = {
    {"scene", "", "The scene."},
    {"settings", "", "Its parameters."},
    {"formulation", "", "The form of the equations."},
    {"multipliers", "", "Accelerations and multipliers at the end: of the last stage, or solved again."},
    {"scalar", "", "The numbers in which the runs were made."},
    {"method", "", "The method."},
    {"family", "", "Its family."},
    {"stages", "", "Its number of stages."},
    {"component", "", "u, v, x or z."},
    {"power_of", "", "h: error over the step. z: over |z| = |h lambda| at a fixed step."},
    {"order", "", "The slope of log error over log h, by least squares; nan: not measurable."},
    {"confidence", "", "Half the width of its 95 % interval."},
    {"h_min", kSceneTime, "The smallest step of the fit; with power_of z the smallest 1/|z|."},
    {"h_max", kSceneTime, "The largest one."},
    {"points", "", "The number of steps in the fit."},
    {"theory", "", "The order by theory; nan: not known."},
    kTheorySourceText,
    {"verdict", "", "agrees (within 0.2, beyond order 20 within 1 %), differs, not_measurable, no_theory."},
    {"reason", "", "Why it is not measurable, or a remark on a difference."},
    kBlockText,
};
constexpr ColumnText kOrderTheory[] = {
    {"scene", "", "The scene."},
    {"settings", "", "Its parameters."},
    {"formulation", "", "The form of the equations."},
    {"multipliers", "", "As in orders.csv."},
    {"method", "", "The method, measured or not."},
    {"family", "", "Its family."},
    {"stages", "", "Its number of stages."},
    {"component", "", "u, v, x or z."},
    {"power_of", "", "As in orders.csv."},
    {"theory", "", "The order by theory."},
    kTheorySourceText,
    kBlockText,
};
constexpr ColumnText kCostAtError[] = {
    {"target_error", "", "The error; the costs belong to it, between runs by a power law."},
    {"cpu_s", "s", "The least CPU time for it."},
    {"residuals", "", "The fewest evaluations of the residual for it."},
    {"newton_iterations", "", "The fewest iterations for it."},
    {"jacobians", "", "The fewest Jacobians for it."},
    {"factorizations", "", "The fewest factorizations for it."},
    {"reached", "", "1: a run of the series has an error up to the target; else 0."},
    {"cause", "", "Why it was not reached."},
    {"least_tolerance", "", "The smallest tolerance of the series."},
    kBlockText,
};
constexpr ColumnText kProfile[] = {
    {"collection", "", "The collection of scenes; all: every scene."},
    {"target_error", "", "The error; all: every one."},
    {"integrator", "", "The solver."},
    {"ratio", "", "A multiple of the best solver's CPU time."},
    {"fraction", "", "On this part of the problems the solver takes at most so many times the best time."},
    {"given", "", "The number of problems that the solver was given."},
    {"problems", "", "The number of all problems: a scene with settings at an error."},
};
constexpr ColumnText kRatios[] = {
    {"block", "", "The block of the study."},
    {"scene", "", "The scene."},
    {"settings", "", "Its parameters."},
    {"method", "", "The method."},
    {"column", "", "The setting that is compared, such as jacobian."},
    {"value", "", "Its value."},
    {"base", "", "Its first value in the block, with which it is compared."},
    {"others", "", "The other settings that vary in the block."},
    {"errors", "", "How many of the targets both reach."},
    {"cpu_s", "", "The median over these errors of the ratio of CPU times."},
    {"residuals", "", "Likewise of residuals."},
    {"newton_iterations", "", "Likewise of iterations."},
    {"jacobians", "", "Likewise of Jacobians."},
    {"factorizations", "", "Likewise of factorizations."},
    {"lost", "", "Errors that only the base reaches."},
    {"won", "", "Errors that only the other value reaches."},
};
constexpr ColumnText kRobustness[] = {
    {"collection", "", "The collection of scenes; all: every scene."},
    {"integrator", "", "The solver; with its formulation where the study has several of it."},
    {"tolerance", "", "The larger one of rtol and atol; all: every one."},
    {"runs", "", "The number of runs, refused ones left out."},
    {"right", "", "Successes with an error up to 1000 tolerances + 1e-9."},
    {"failed", "", "Runs that report a failure."},
    {"wrong", "", "Successes with a larger error."},
    {"unjudged", "", "Successes without a reference that is accurate enough."},
    {"outcomes", "", "The failed ones by outcome."},
};
constexpr ColumnText kGaps[] = {
    {"scene", "", "The scene."},
    {"settings", "", "Its settings that are not the default ones."},
    {"tolerance", "", "The larger one of rtol and atol."},
    {"solver", "", "The solver; with its formulation where the study has several of it."},
    {"judgement", "",
     "failed: the run reports a failure; wrong: a success with an error above 1000 tolerances + 1e-9."},
    {"outcome", "", "How the run ended."},
    {"detail", "", "Why."},
    {"right", "", "The solvers whose runs of the same problem are right."},
};
constexpr ColumnText kEstimates[] = {
    {"rtol", "", "Tolerance of the run from which the step begins."},
    {"t", kSceneTime, "Where the step begins."},
    {"h", kSceneTime, "Its size."},
    {"group", "", "u, v, x or z: values are the largest of the group."},
    {"difference", "scales", "Between one step and two half steps."},
    {"error", "scales", "The true error of the two half steps."},
    {"doubling", "", "True error over the paper's estimate, which divides by 2^p - 1."},
    {"richardson", "", "True error over the estimate with the order of each component."},
};
constexpr ColumnText kContractions[] = {
    {"rtol", "", "Tolerance of the run."},
    {"solve", "", "The number of the solve in its run."},
    {"iterations", "", "Its iterations."},
    {"c1", "", "Residual after the first iteration over the residual before it; c2 to c6: of the next ones."},
    {"c2", "", "See c1."},
    {"c3", "", "See c1."},
    {"c4", "", "See c1."},
    {"c5", "", "See c1."},
    {"c6", "", "See c1; nan where fewer iterations were needed."},
};
constexpr ColumnText kEnergy[] = {
    {"h", kSceneTime, "The constant step."},
    {"t", kSceneTime, "The time."},
    {"energy_error", "the scene's unit of energy", "Energy minus its value at the start."},
    {"drift", "energy per time", "Of the whole run: the slope of a line through the errors."},
    {"scatter", "the scene's unit of energy", "Of the whole run: root mean square distance from that line."},
    {"largest", "the scene's unit of energy", "Of the whole run: the largest error."},
};
constexpr ColumnText kPhases[] = {
    {"rtol", "", "Tolerance of the run."},
    {"n", "", "Unknowns of one stage."},
    {"residual_s", "s", "One evaluation of the residual at one stage."},
    {"jacobian_s", "s", "One Jacobian."},
    {"factorization_s", "s", "One factorization of the Newton matrix."},
    {"solve_s", "s", "One solution with it."},
    {"update_s", "s", "The rest of an iteration."},
    {"step_s", "s", "The rest of an attempted step."},
    {"start_s", "s", "The start of an integration, with the search for the Jacobian's pattern."},
    {"share_residual", "", "Time times counter over the sum of all parts."},
    {"share_jacobian", "", "Likewise."},
    {"share_factorization", "", "Likewise."},
    {"share_solve", "", "Likewise."},
    {"share_update", "", "Likewise."},
    {"share_step", "", "Likewise."},
    {"share_start", "", "Likewise."},
    {"run_s", "s", "The whole run."},
    {"covered", "", "Sum of the parts over run_s; below 0.9 or above 1.1 the shares are unreliable."},
};
constexpr ColumnText kScaling[] = {
    {"n", "", "Unknowns of one stage."},
    {"step_s", "s", "Median time of an accepted step with the attempts before it, by the clock on the wall."},
    {"step_cpu_s", "s", "The same on the CPU clock of the calling thread."},
    {"iterations", "", "Iterations of Newton's method per step."},
};
constexpr ColumnText kScalingSlopes[] = {
    {"scene", "", "The scene."},
    {"formulation", "", "The form of the equations."},
    {"solver", "", "The stage solver."},
    {"storage", "", "dense or sparse matrices."},
    {"threads", "", "Threads of one run."},
    {"over", "", "n or stages."},
    {"at", "", "What is kept: the method, or n."},
    {"slope", "", "The slope of log step_cpu_s (of several threads, log step_s) over log n (n >= 200) or log stages."},
    {"confidence", "", "Half the width of its 95 % interval."},
    {"points", "", "The number of points."},
};

constexpr ColumnText kParallel[] = {
    {"n", "", "Unknowns of one stage."},
    {"way", "", "threads: one run on several threads; runs: as many runs at a time, on one thread each."},
    {"processors", "", "The number of threads, or of runs at a time."},
    {"wall_s", "s", "The time until all are finished, set-up included: the least of five by the clock on the wall."},
    {"speedup", "", "Runs per second over those on one processor."},
    {"efficiency", "", "speedup / processors."},
    {"serial_share", "",
     "The part of the work that one processor does alone, by Amdahl's law; the speed-up stays below 1 / serial_share."},
};

constexpr TableText kRunTables[] = {
    {"environments.csv", "a machine with a build", SharedColumns::kNone, kEnvironments},
    {"calibrations.csv", "a fixed computation, timed beside the runs", SharedColumns::kNone, kCalibrations},
    {"timing_cores.csv", "a number of cores on which times might be measured at once", SharedColumns::kNone,
     kTimingCores},
    {"states.csv", "the state at the end of a run (studies that keep states)", SharedColumns::kNone, kStates},
    {"irk solve --out FILE.csv",
     "a step, a point, or a side of a switch; SCENE.METHOD.csv of studies with trajectories has the same columns",
     SharedColumns::kNone, kSolution},
    {"orders.csv", "the observed order of one component of one series", SharedColumns::kNone, kOrders},
    {"order_theory.csv", "the theoretical order of one component", SharedColumns::kNone, kOrderTheory},
    {"cpu_at_error.csv", "the cost of a series at one error", SharedColumns::kSeries, kCostAtError},
    {"profile.csv", "a point of a performance profile (Dolan and Moré, 2002)", SharedColumns::kNone, kProfile},
    {"ratios.csv", "what one choice costs over the block's first one at equal errors", SharedColumns::kNone, kRatios},
    {"robustness.csv", "how the runs of a solver at one tolerance end", SharedColumns::kNone, kRobustness},
    {"gaps.csv", "a run that is not right although another solver's is", SharedColumns::kNone, kGaps},
    {"estimates.csv", "estimated and true error of a step", SharedColumns::kSeries, kEstimates},
    {"contractions.csv", "one solve of the paper's Newton method", SharedColumns::kSeries, kContractions},
    {"energy.csv", "the energy at one time of a run with constant steps", SharedColumns::kSeries, kEnergy},
    {"phases.csv", "the parts of a run in its time", SharedColumns::kSeries, kPhases},
    {"scaling.csv", "the time of a step", SharedColumns::kSeries, kScaling},
    {"scaling_slopes.csv", "how the time of a step grows", SharedColumns::kNone, kScalingSlopes},
    {"parallel.csv", "a run on a number of processors", SharedColumns::kSeries, kParallel},
};

}  // namespace

std::span<const TableText> tableTexts() { return kRunTables; }

}  // namespace irk
