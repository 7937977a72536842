// The cost of an integration, counted in operations. Counts, unlike times, do not depend on the machine's load.
#pragma once

#include <cstdint>

namespace irk {

/// Counts of one integration; they start at 0 with each call of Integrator::integrate.
struct Counters {
  std::int64_t residuals = 0;       ///< evaluations of r over plain numbers
  std::int64_t dual_residuals = 0;  ///< evaluations of r over dual numbers (8 directions each)
  std::int64_t jacobians = 0;  ///< evaluations of (D0, D1, D2) at one point, of D0 alone at starts, restarts and ends
  std::int64_t factorizations = 0;  ///< of the Newton matrix (all its blocks together count as one)
  /// of D0 = dr/d(a, k, z) alone, which holds the mass matrix, between the start and the end: by first-order forms,
  /// projections, restarts and checks of a step. The consistent start and the multipliers of the end are left out.
  std::int64_t mass_factorizations = 0;
  /// of D0 + h mu D1 + (h mu)^2 D2, the one system of n unknowns that filters an error estimate and the defect, where
  /// the factors of the Newton matrix do not contain it
  std::int64_t filter_factorizations = 0;
  std::int64_t solves = 0;             ///< with a factorized Newton matrix (all its blocks together count as one)
  std::int64_t filter_solves = 0;      ///< with the filter's system of n unknowns, wherever its factors are
  std::int64_t newton_iterations = 0;  ///< of all attempted steps
  /// iterations begun anew from the start values, with a new Jacobian or full Newton (paper)
  std::int64_t newton_restarts = 0;
  std::int64_t steps_accepted = 0;
  std::int64_t steps_rejected_error = 0;      ///< attempts with too large an error estimate
  std::int64_t steps_rejected_newton = 0;     ///< attempts in which Newton's method, or the search for a switch, failed
  std::int64_t switches = 0;                  ///< changes of the discrete state
  std::int64_t discontinuous_iterations = 0;  ///< `iterate`: steps repeated with a new discrete state
  std::int64_t located_events = 0;            ///< `locate`: steps that end at a switch
  std::int64_t chattering = 0;                ///< sequences of steps that each end with a switch

  /// Calls f(name, value) for each counter, in the order of the columns of tables.
  template <class F>
  void forEach(F&& f) const {
    f("residuals", residuals);
    f("dual_residuals", dual_residuals);
    f("jacobians", jacobians);
    f("factorizations", factorizations);
    f("mass_factorizations", mass_factorizations);
    f("filter_factorizations", filter_factorizations);
    f("solves", solves);
    f("filter_solves", filter_solves);
    f("newton_iterations", newton_iterations);
    f("newton_restarts", newton_restarts);
    f("steps_accepted", steps_accepted);
    f("steps_rejected_error", steps_rejected_error);
    f("steps_rejected_newton", steps_rejected_newton);
    f("switches", switches);
    f("discontinuous_iterations", discontinuous_iterations);
    f("located_events", located_events);
    f("chattering", chattering);
  }
};

}  // namespace irk
