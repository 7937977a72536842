// Integrates a system from a start to an end time.
#pragma once

#include <memory>

#include "irk/monitor.h"
#include "irk/options.h"
#include "irk/system.h"
#include "irk/tableau.h"

namespace irk {

/// Integrates one system with one set of options. An object may be used for any number of integrations, one
/// after the other; use one object per thread. The system may be shared by threads unless it keeps scratch
/// (first-order form). The constructor allocates; steps do not.
template <class Real>
class Integrator {
 public:
  /// Shares ownership of `system`; copies the rest. `scale`: typical magnitudes > 0 of u, v, x, z
  /// (2 nu + nx + nz numbers); empty means 1.
  /// Throws Misuse for an invalid system or scale (irk/system_check.h), for options out of range, and for combinations
  /// that do not work; the message names both ids and the reason. A tableau is checked as in irk/tableau.h. Examples of
  /// such combinations: several methods without variable order, variable order without the estimate `embedded`, a
  /// singular A with algebraic unknowns, a defective A with `eigen`, Newton `full` with a decoupled solver.
  Integrator(std::shared_ptr<const System<Real>> system, const Methods<Real>& methods, const IntegratorOptions& options,
             const Vec<double>& scale = {});
  ~Integrator();
  /// Not while `integrate` is under way.
  Integrator(Integrator&&) noexcept;

  /// Integrates from `start` (in the scene's unknowns u, v, x, z) to t_end. If t_end < start.t, it goes backward in
  /// time: `monitor` then sees falling times and negative step sizes. Numerical failures are returned as
  /// Solution::outcome (kNotFinite for a start with a NaN); Solution::state is then the last accepted state.
  /// Throws Misuse, before the first step, for a start whose sizes differ from the scene's, for times that are
  /// not finite; for t_end < start.t with a system that has switches, a discrete state or, at a declared time on the
  /// way, a jump, which cannot be undone; for a call while another one of this object is under way, as from `monitor`;
  /// for an object that has been moved from; and for a system that makes states of other sizes than its own. Exceptions
  /// of `monitor` and of the system leave this call, with any number of threads; the object may be used again.
  /// `monitor` is called during this call only.
  [[nodiscard]] Solution<Real> integrate(const State<Real>& start, const Real& t_end,
                                         const Monitor<Real>& monitor = {});

  /// The magnitudes that atol is multiplied by in the following integrations, instead of those of the constructor:
  /// those of the first components of (u, v, x, z), all > 0. A component with a very small one is controlled by rtol
  /// alone. With NormKind::kAbsolute a component counts relative to atol (scale_i + |y_i|) where that is below atol.
  /// Empty: those of the constructor again. Throws Misuse for other numbers, and during `integrate`.
  void weighErrorsBy(const Vec<double>& scale);
  /// The longest step from now on, if it is shorter than StepOptions::h_max; infinity: that one again. May be called
  /// from Monitor::accepted, for the steps that follow. Throws Misuse unless it is > 0.
  void limitSteps(double h_max);
  /// The system, as given to the constructor.
  const System<Real>& system() const;

 private:
  class Run;
  std::unique_ptr<Run> run_;
};

}  // namespace irk
