// Integrates many small systems that differ in parameters or starts, eight at a time in the lanes of a vector register.
//
// Each lane takes its own steps: its step size, convergence, Jacobian, error and counters are those of a single run of
// its system, and do not depend on its neighbours (bit for bit). A lane that ends takes the next system. The algorithm
// is that of the configuration `embedded` with newton `simplified`; results equal those of single runs but for
// rounding.
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

/// One system of an ensemble, as a single run has it.
struct EnsembleMember {
  std::shared_ptr<const System<double>> system;
  State<double> start;  ///< in the scene's unknowns
  double t_end = 0;
  Vec<double> scale = {};  ///< magnitudes of u, v, x, z; empty means 1
};

/// Many systems of the same sizes.
struct Ensemble {
  /// Makes member i. Called once for each member, when a lane is free for it.
  std::function<EnsembleMember(std::size_t i)> member;
  /// The system whose lane k has the equations of member at[k].
  std::function<std::shared_ptr<const System<Lanes>>(const std::array<std::size_t, kLanes>& at)> lanes;
};

/// Integrates members of ensembles with one method and one set of options. Use one object per thread; several may
/// share an ensemble whose functions allow it. The constructor and each new member allocate; steps do
/// not, except where extrapolated start values are cut to a lower degree (many stages, growing steps).
class LaneIntegrator {
 public:
  /// Names the next member, as long as there is one.
  using Next = std::function<std::optional<std::size_t>()>;
  /// Takes the result of member i.
  using Done = std::function<void(std::size_t i, Solution<double> solution)>;

  /// Throws Misuse for options out of range, for those other than of the configuration `embedded` with newton
  /// `simplified` (see laneOptions), and for methods other than stiffly accurate ones with invertible A.
  LaneIntegrator(const Tableau<double>& tableau, const IntegratorOptions& options);
  ~LaneIntegrator();
  LaneIntegrator(LaneIntegrator&&) noexcept;

  /// Integrates the members that `next` names until it names no more, and calls `done` with the result of each, in the
  /// order in which they end. A failed member has its outcome and the reason, and disturbs no other. After `stop`
  /// returns another outcome than kSuccess (called before each step) all members that are under way end with it, and no
  /// more are begun.
  /// Throws Misuse for a system that lanes cannot integrate: with switches, times, algebraic unknowns of index 2 that
  /// are no multipliers, a projection of velocities, or more than kMostLaneUnknowns unknowns.
  void integrate(const Ensemble& ensemble, const Next& next, const Done& done,
                 const std::function<Outcome()>& stop = {});

 private:
  class Run;
  std::unique_ptr<Run> run_;
};

/// Lanes are for small systems with dense Jacobians.
inline constexpr Index kMostLaneUnknowns = 32;

/// `options` with the strategies that lanes have.
IntegratorOptions laneOptions(IntegratorOptions options);

}  // namespace irk
