// Integrates many small systems that differ in parameters or starts, eight at a time in the lanes of a vector register.
//
// Each lane takes its own steps. Its step size, convergence, Jacobian, error and counters are those of a single run of
// its system and do not depend on its neighbours (bit for bit). A lane that ends takes the next system. The algorithm
// is that of the configuration `embedded` with newton `simplified`; results equal those of single runs up to rounding.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "irk/lanes.h"
#include "irk/monitor.h"
#include "irk/options.h"
#include "irk/tableau.h"

namespace irk {

/// One system of an ensemble, with the arguments of a single run.
struct EnsembleMember {
  std::shared_ptr<const System<double>> system;
  State<double> start;  ///< in the scene's unknowns; sizes as system->sceneSizes()
  double t_end = 0;
  Vec<double> scale = {};  ///< magnitudes > 0 of u, v, x, z (2 nu + nx + nz numbers); empty means 1
};

/// Many systems of the same sizes. The functions must be safe for all threads whose integrators share the ensemble.
struct Ensemble {
  /// Makes member i. Called once for each member, when a lane is free for it.
  std::function<EnsembleMember(std::size_t i)> member;
  /// Makes the system whose lane k has the equations of member at[k].
  std::function<std::shared_ptr<const System<Lanes>>(const std::array<std::size_t, kLanes>& at)> lanes;
};

/// Integrates members of ensembles with one method and one set of options. Use one object per thread; several may
/// share an ensemble whose functions allow it. The constructor and each new member allocate; steps do
/// not, except where extrapolated start values are cut to a lower degree (many stages, growing steps).
class LaneIntegrator {
 public:
  /// Returns the next member; nothing if there is none left.
  using Next = std::function<std::optional<std::size_t>()>;
  /// Receives the result of member i.
  using Done = std::function<void(std::size_t i, Solution<double> solution)>;

  /// Throws Misuse for options out of range, for options other than those of the configuration `embedded` with newton
  /// `simplified` (see laneOptions), and for methods that are not stiffly accurate or have a singular A.
  LaneIntegrator(const Tableau<double>& tableau, const IntegratorOptions& options);
  ~LaneIntegrator();
  LaneIntegrator(LaneIntegrator&&) noexcept;

  /// Integrates the members that `next` returns until it returns none, and calls `done` with the result of each, in the
  /// order in which they end. The result of a failed member holds its outcome and the reason; other members are not
  /// affected. `stop` is called before each step: if it returns an outcome other than kSuccess, all members under way
  /// end with that outcome, and no more are begun.
  /// Throws Misuse for a system that lanes cannot integrate: one with switches, times, algebraic unknowns of index 2
  /// other than multipliers, a projection of velocities, or more than kMostLaneUnknowns unknowns; for systems, also
  /// those of `lanes`, that are null or differ from the first one in sizes or formulation; for a missing function; for
  /// a call while another one of this object is under way; and for an object that has been moved from. Exceptions of
  /// the functions leave this call; the object may be used again.
  void integrate(const Ensemble& ensemble, const Next& next, const Done& done,
                 const std::function<Outcome()>& stop = {});

 private:
  class Run;
  std::unique_ptr<Run> run_;
};

/// The largest number of unknowns: lanes are for small systems with dense Jacobians.
inline constexpr Index kMostLaneUnknowns = 32;

/// Returns `options` with the strategies that lanes support.
IntegratorOptions laneOptions(IntegratorOptions options);

}  // namespace irk
