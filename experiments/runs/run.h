// Executes a RunSpec and returns a RunRecord: a pure function except for the times.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "experiments/runs/error_bar.h"
#include "experiments/runs/references/made_reference.h"
#include "experiments/runs/run_errors.h"
#include "experiments/runs/run_spec.h"
#include "irk/monitor.h"
#include "irk/outcome.h"
#include "irk/statistics.h"

namespace irk {

/// A change of the mode.
struct SwitchEvent {
  double t;
  std::string name;  ///< of the switching function
};

/// The change of an invariant of the scene.
struct InvariantChange {
  std::string name, unit;
  double start;  ///< its value at the start
  /// The largest distance from its value at the start, over all accepted steps; NaN if it is not finite.
  double change;
};

struct RunRecord {
  RunSpec spec;
  std::string family;
  Index stages = 0;
  std::string outcome;  ///< as irk::name(Outcome), or `refused` or `exception` (asRow)
  std::string detail;   ///< of a failure, in one line
  double t = std::numeric_limits<double>::quiet_NaN();
  Vec<double> u, v, x, z;                ///< the last accepted state
  std::vector<std::string> digits = {};  ///< u, v, x, z with all digits; of multiprecision runs only
  RunErrors errors = {};
  /// the largest errors at the spec's reference_times; unknown unless the run is a success
  RunErrors errors_over_time = {};
  RunErrorBar error_bar = {};
  Counters counters;
  std::vector<SwitchEvent> switches = {};        ///< the first kMaxRecordedSwitches
  std::vector<InvariantChange> invariants = {};  ///< empty unless Watch::invariants is set
  double cpu_s = std::numeric_limits<double>::quiet_NaN();

  bool succeeded() const { return outcome == name(Outcome::kSuccess); }
};

/// Limit of recorded switches, because a chattering run has arbitrarily many.
constexpr std::size_t kMaxRecordedSwitches = 1000;

/// The solution inside an accepted step, see InsideStep in irk/monitor.h.
class ValuesInside {
 public:
  /// The components and outputs of PreparedRun::columns at t.
  virtual std::vector<double> at(double t) = 0;

 protected:
  ~ValuesInside() = default;
};

/// An accepted step, or the start, where h and error are NaN and the iterations 0.
struct AcceptedStep {
  double t;  ///< at its end
  double h;
  double error;  ///< estimate in units of the tolerance; NaN without one
  int newton_iterations;
  std::span<const double> values;  ///< the components and outputs of PreparedRun::columns
  ValuesInside* inside = nullptr;  ///< valid during the callback; null if not asked for, or not known (peers)
};

/// The caller's stop flags and callbacks during a run. All are optional.
struct Watch {
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const AcceptedStep&)> accepted;
  /// Called at each change of the mode with the values just after it: after the step that ends at the switch
  /// (`locate`), or before the step in which the mode changes.
  std::function<void(double t, const std::string& name, std::span<const double> values)> switched;
  /// Makes the reference of a run with `reference = auto` for which nothing is stored (needsReference). Called after
  /// the integration, with the resolved spec. Without this function the error is unknown.
  std::function<MadeReference(const RunSpec& spec)> reference = {};
  /// Called before each step of the integration that measures the error bar, with the part of the interval that it has
  /// covered.
  std::function<void(double part)> measuring = {};
  bool invariants = false;  ///< whether to follow the scene's invariants, which takes time in each step
  bool inside = false;      ///< whether `accepted` needs AcceptedStep::inside
  const std::atomic<bool>* cancelled = nullptr;  ///< a stop flag of this run alone
};

/// Scene, method and integrator of a spec: built once, run as often as wanted. Use one object per thread.
class PreparedRun {
 public:
  virtual ~PreparedRun() = default;
  virtual RunRecord execute(const Watch& watch) = 0;
  /// Runs the integration only, for timing.
  virtual void integrate() = 0;
  /// Makes, for timing, what a user's call makes before the integration if the scene is given: the system in its
  /// formulation, the method's coefficients, the integrator.
  virtual void setUp() = 0;
  /// Calls `setUp` and integrates once with its results, for timing.
  virtual void wholeCall() = 0;
  /// The names of the components u, v, x, z and of the scene's outputs.
  virtual std::vector<std::string> columns() const = 0;
  /// Replaces components of u, v, x of the scene's start, given by name with decimal values, in all following runs. The
  /// scene's exact solution and references are those of its own start: errors are unknown from now on. Throws Misuse
  /// for another name and for a text that is no number.
  virtual void startFrom(const Settings& components) = 0;
};

/// Builds the scene, method and integrator of a spec. Throws Misuse for every spec that can never work.
std::unique_ptr<PreparedRun> prepare(const RunSpec& spec);

/// Prepares and makes a run. Throws Misuse as `prepare`.
RunRecord execute(const RunSpec& spec, const Watch& watch = {});

/// Integrates a spec in double precision with an implicit Runge-Kutta method, starting at `start`, a state of the
/// scene that may differ from the scene's own start, up to the spec's t_end. Throws Misuse as `prepare`, and for a
/// peer.
Solution<double> integrateFrom(const RunSpec& spec, const State<double>& start, const Watch& watch = {});

/// For sweeps and studies: returns `make()`. If it throws, a record without numbers, and the reason in `detail`: with
/// outcome `refused` for Misuse, `exception` for what a user's code throws (named by codeOf, own_files.h). Other
/// exceptions, of a full disk or of the program itself, go on.
RunRecord asRow(const RunSpec& spec, const std::function<RunRecord()>& make);

}  // namespace irk
