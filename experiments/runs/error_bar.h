// The error bar of a run: the run that measures it, and its numbers in the scene's terms.
#pragma once

#include <functional>
#include <limits>
#include <string>

#include "experiments/runs/run_spec.h"
#include "irk/error_bar.h"
#include "irk/monitor.h"
#include "irk/scene.h"

namespace irk {

/// The measured error of a result. If it is not asked for, u, v, x and z are empty, and known() says nothing.
struct RunErrorBar : ErrorBar {
  std::string component = {};  ///< the name of the worst one; empty if the bar is unknown
  /// The largest |e| / max(|y|, scale), the measure of RunErrors, over u, v, x and over z.
  double error = std::numeric_limits<double>::quiet_NaN();
  double error_z = std::numeric_limits<double>::quiet_NaN();
  bool refined = false;  ///< whether the result is now that of a stricter integration, which the bar does not judge
  /// Of the integrations that measure it, without what is made before them.
  double cpu_s = std::numeric_limits<double>::quiet_NaN();

  /// The problem or the remark, whichever there is, or nothing.
  const std::string& told() const { return problem.empty() ? remark : problem; }
};

/// The run that measures the error of a run with this resolved spec: Radau IIA, or Lobatto IIIC if the run's method is
/// one of Radau IIA, from a file or of another library, with variable order, index 2, switches located (or smooth, if
/// the run's are), and independentOptions. It is the maker of all independent runs.
RunSpec independentSpec(const RunSpec& spec);

/// Families of methods whose runs are independent of each other.
enum class IndependentFamily { kRadauIIA, kLobattoIIIC };

/// A strict run of the scene, settings, t_end and treatment of switches of `question` by methods of this family, as
/// independentSpec makes them, with rtol = atol = `tolerance` and steps up to `h_max`. Two of them that agree are a
/// reference.
RunSpec strictRun(const RunSpec& question, IndependentFamily family, double tolerance, double h_max);

/// Callbacks of the integrations that measure, before each of their steps.
struct MeasuringWatch {
  /// kSuccess: it goes on. Else it ends with that outcome.
  std::function<Outcome()> interrupt;
  /// Gets the part of the interval that is covered. May be empty.
  std::function<void(double part)> progress;
};

/// Measures the error of `solution`, the result of a run with the resolved `spec`, by an integration of
/// independentSpec, with the run's scene; does nothing unless it is a success and the spec asks for it. If that
/// integration fails, the same one with the run's own tolerance measures it. A bar that asksForStricter is measured
/// again by independentSpec of the second run. With ErrorBarUse::kRefined the solution takes the state of the strictest
/// integration that succeeds, if it is stricter than the run. Real: double or BigFloat, as the spec's scalar.
template <class Real>
RunErrorBar measuredErrorBar(const RunSpec& spec, const Scene<Real>& scene, Solution<Real>& solution,
                             const MeasuringWatch& watch);

/// Why a result with this error bar is no success: `the error bar is 3e+04 tolerances, largest in theta`, if it is
/// above largestErrorBar (irk/error_bar.h). Empty if it may be one, and for runs with fixed steps, which have no
/// tolerance.
std::string doubtOf(const RunErrorBar& bar, const RunSpec& spec);

}  // namespace irk
