#include "experiments/commands/columns/column_texts.h"

namespace irk {
namespace {

constexpr ColumnText kRunColumns[] = {
    {"key", "", "A hash of all that determines the run's numbers: a finished run is found by it and not repeated."},
    {"study", "", "The study that made the run."},
    {"family", "", "The family of the method, such as radau_iia; of another library's integrator its name."},
    {"stages", "", "The number of stages of the method; 0 for other libraries' integrators."},
    {"integrator", "",
     "The solver in figures and summaries: the configuration with its method, or the other library's."},
    {"outcome", "", "success, or how the run failed: outcomes.md."},
    {"t", "the scene's time unit", "The time that the run has reached: t_end, or that of the event at which it ended."},
    {"error", "", "The largest |y - ref| / max(|ref|, scale) of all components and outputs at t_end."},
    {"error_u", "", "The same over the positions u."},
    {"error_v", "", "The same over the velocities v."},
    {"error_x", "", "The same over the first-order unknowns x."},
    {"error_z", "", "The same over the algebraic unknowns z, such as multipliers."},
    {"error_t", "the scene's time unit", "The error of the time at which a switch ended the run (stop_at)."},
    {"drift", "that of the constraint", "The largest |g| of the position constraints at t_end."},
    {"invariant_change", "",
     "The largest change of an invariant, such as an energy, over the magnitude of its value at the start. The change "
     "itself where that value is 0 or below 1e-9 of the change."},
    {"mescd", "digits", "-log10 of the largest |y - ref| / (atol/rtol + |ref|), as the IVP test set counts."},
    {"scd", "digits", "-log10 of the largest |y - ref| / |ref|."},
    {"reference_accuracy", "", "The accuracy of a computed reference. Errors below ten times of it are not measured."},
    {"error_over_time", "", "The largest error at any of the reference_times."},
    {"error_u_over_time", "", "The same over u."},
    {"error_v_over_time", "", "The same over v."},
    {"error_x_over_time", "", "The same over x."},
    {"error_z_over_time", "", "The same over z."},
    {"error_bar", "", "The distance from a second integration, largest |e| / max(|y|, scale) of u, v and x."},
    {"error_bar_z", "", "The same over z."},
    {"error_bar_tolerances", "tolerances", "The largest |e| / (atol scale + rtol |y|) of u, v and x."},
    {"residuals", "", "Evaluations of the residual over plain numbers."},
    {"dual_residuals", "", "Evaluations of the residual with derivatives in eight directions each."},
    {"jacobians", "", "Evaluations of the Jacobian at one point; at starts, restarts and ends only of its part D0."},
    {"factorizations", "", "Factorizations of the Newton matrix, all of its blocks together."},
    {"mass_factorizations", "", "Factorizations of D0, which holds the mass matrix, between start and end."},
    {"solves", "", "Solutions with a factorized Newton matrix."},
    {"newton_iterations", "", "Iterations of Newton's method in all attempted steps."},
    {"newton_restarts", "", "Iterations that were begun anew from the start values with a new Jacobian."},
    {"steps_accepted", "", "Accepted steps."},
    {"steps_rejected_error", "", "Steps that were repeated because the estimated error was too large."},
    {"steps_rejected_newton", "", "Steps that were repeated because Newton's method failed."},
    {"switches", "", "Changes of the mode."},
    {"discontinuous_iterations", "", "Steps that discontinuity iterate repeated with a new mode."},
    {"located_events", "", "Steps that discontinuity locate ended at a switch."},
    {"chattering", "", "Sequences of steps that each end with a switch."},
    {"cpu_s", "s", "CPU time: the least of the timed whole calls; of a run that was not timed, the integration's."},
    {"cpu_setup_s", "s", "The part of a whole call before the integration: system, coefficients, integrator."},
    {"cpu_median_s", "s", "The median of the timed calls."},
    {"cpu_spread", "", "(largest - least) / least of the timed calls."},
    {"cpu_runs", "", "The number of timed calls; 0: not timed."},
    {"cpu_all", "s", "Each timed call, in the order in which they were made."},
    {"cpu_environment", "", "Where the times were measured: a row of environments.csv."},
    {"cpu_error_bar_s", "s", "CPU time of the second integration, which measures the error bar."},
    {"detail", "", "Why the run failed, and why it has no error, no error bar or no times, in one line."},
    {"files", "", "The user's files that the run needs: absolute paths with ':' between them."},
    {"code", "", "A hash of the sources that determine numbers. Rows of other code are kept but not used."},
    {"environment", "", "Where the row was made: a row of environments.csv."},
    {"date", "", "When the row was written, in UTC."},
    {"remade", "",
     "The number of the last --fresh that asked for the run: one more than any that is stored, where a date of a "
     "former version counts as its seconds. Else empty."},
    {"block", "", "The names of the study's blocks that contain the run."},
};

}  // namespace

std::span<const ColumnText> runColumnTexts() { return kRunColumns; }

}  // namespace irk
