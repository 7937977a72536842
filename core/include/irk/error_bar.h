// The error bar of a result: its distance from a second, independent integration.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "irk/integrator.h"

namespace irk {

/// The measured error of a result, component by component, in the scene's unknowns and their units. NaN: unknown.
struct ErrorBar {
  Vec<double> u, v, x, z;  ///< |result - second result|, and what located switches and late times add
  /// The largest of |e_i| / (atol scale_i + rtol |y_i|) over u, v and x, with the smaller |y_i| of the two results; NaN
  /// if the bar is unknown.
  double tolerances = std::numeric_limits<double>::quiet_NaN();
  /// |t - second t| of a run that ends at a switch (stop_at); NaN of others.
  double t = std::numeric_limits<double>::quiet_NaN();
  Index worst = -1;  ///< the component of (u, v, x) with the largest error in tolerances
  /// The largest |e_i| over the distance of y_i from its start, the largest one of the second integration, among the
  /// components of (u, v, x) whose |e_i| is above 10 tolerances; 0 if there are none.
  double part_of_motion = 0;
  std::string problem;  ///< why the bar is unknown, in one line; empty if it is known
  std::string remark;   ///< what a known bar may not show, in one line; empty if there is nothing to say

  bool known() const { return problem.empty(); }
};

/// The options of the integration that measures the error of a run with the options `first`. They have a tenth of its
/// tolerance (but at least 50 epsilon of Real), variable order with the embedded estimate, and full Jacobians of dual
/// numbers; what the user says of the system and the machine stays: norm, storage, threads, limits of steps. A run with
/// fixed steps is measured with the tolerance 1e-10. Independent of the run are then the method (take another family:
/// Radau IIA, or Lobatto IIIC, which needs more steps, for a run of Radau IIA), its nodes, its steps and its
/// estimate; common are the equations, the formulation and the treatment of switches.
template <class Real>
IntegratorOptions independentOptions(const IntegratorOptions& first);

/// Measures the error of a `result` at the time result.t by a second integration of the same problem from `start` with
/// `second`, which should have independentOptions. `second_result` is the result of the integration that measures.
/// States are in the scene's unknowns; `scale`: magnitudes of their components as in Integrator, empty means 1. With a
/// tenth of the tolerance the second result is nearly exact beside the first, so that their distance is the error
/// itself: over 700 drawn runs of scenes that nobody tuned for, the median of bar over true error is 1.
/// Components that are below their absolute tolerance for whole steps of the second integration need not have a correct
/// digit there, and may matter later: an epidemic of one case, a pendulum that stands upright, a delayed loss of
/// stability. Two integrations may agree on a wrong result then. So the second one begins anew with each component that
/// it finds small and, by its estimate, not accurate beside its size, and controls it relative to its size in either
/// norm; not, where rests are watched (scene's unknowns, up to 50 components), the velocity of a position above its
/// tolerance. If that fails or takes more steps than kBarEffort over the unknowns, it is done as usual, with a
/// `remark`: a fast motion far below the tolerance could need any number of steps. Both integrations have the round-off
/// of the scene's switching functions, which their distance does not show: each located switch adds what the error of
/// its time changes behind it, by the other rates and the jump there (the saltation matrix, Leine and Nijmeijer 2004,
/// chapter 7, times that error; LocatedSwitch). So does the time that the second one loses by rounding t + h, where
/// times are far larger than steps. Both can miss the same thing, as a pulse of the input that lasts less than 2 /
/// looks of the interval and is not declared. If the second integration fails, the bar is unknown and `problem` says
/// why; near round-off one with the tolerance of the result may succeed, whose own error is then in the bar as well.
/// Throws Misuse as Integrator::integrate, and for a result of other sizes than the start, a scale or tolerances out of
/// range.
/// A run with the option stop_at has ended at a switch: `second` has the same option, ends at its own time of the
/// switch, and may go up to t_end, which is then given.
template <class Real>
[[nodiscard]] ErrorBar measureErrorBar(const State<Real>& result, Integrator<Real>& second, const State<Real>& start,
                                       const Tolerances& tolerances, const Vec<double>& scale,
                                       Solution<Real>& second_result, const Monitor<Real>& monitor = {},
                                       const std::optional<Real>& t_end = {});

/// Whether a bar is so large that it has to be measured again, more strictly: above 10 tolerances and above a tenth of
/// the motion of its component. The second integration has a tenth of the tolerance, and a motion that amplifies errors
/// leaves it a tenth of the first one's error, as long as errors are small beside the motion. Where they have grown to
/// its size the second result is as wrong as the first. A third integration, with independentOptions of the second
/// one's options and another family, then gives a second distance; the bar is the `larger` of both. Not for runs with
/// fixed steps, which are measured with a tolerance of their own, nor where only the result's own tolerance could
/// measure. A large transient at the start hides what happens in a small motion after it. False for an unknown bar.
bool asksForStricter(const ErrorBar& bar);

/// The larger one of two known bars of one result, component by component.
ErrorBar larger(const ErrorBar& a, const ErrorBar& b);

/// A success should be right to this many tolerances: 1000, and 1e-9 beside it, where round-off is.
double largestErrorBar(const Tolerances& tolerances);

}  // namespace irk
