// From a start to an end: accepted steps, their record, and how it ended.
#pragma once

#include <memory>

#include "irk/monitor.h"
#include "irk/options.h"
#include "irk/system.h"
#include "irk/tableau.h"

namespace irk {

/// One integration at a time; reusable. Allocates in its constructor, not in its steps. One per
/// thread; the system and the tableau are shared.
template <class Real>
class Integrator {
 public:
  /// `scale`: typical magnitudes of u, v, x, z (2 nu + nx + nz); empty = 1.
  /// Throws Misuse for a system that cannot be (core/include/irk/system_check.h) and for illegal combinations, naming both ids and the reason: several methods but
  /// with variable order and the estimate `embedded`, a family that cannot treat algebraic unknowns, `eigen` with a defective A, `full` with a decoupled solver, ...
  Integrator(std::shared_ptr<const System<Real>> system, const Methods<Real>& methods,
             const IntegratorOptions& options, const Vec<double>& scale = {});
  ~Integrator();
  Integrator(Integrator&&) noexcept;

  /// From `start` (the scene's u, v, x, z) to t_end. Returns every numerical failure as an outcome, kNotFinite for a
  /// start with a NaN. Throws Misuse for a start of other sizes than the scene's, and for times that are not finite or
  /// in the wrong order.
  [[nodiscard]] Solution<Real> integrate(const State<Real>& start, const Real& t_end,
                                         const Monitor<Real>& monitor = {});

 private:
  class Run;
  std::unique_ptr<Run> run_;
};

}  // namespace irk
