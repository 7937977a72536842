#include "core/integration/end_check.h"

#include <sstream>

#include "core/derivatives/constraint_check.h"
#include "core/derivatives/projection.h"
#include "irk/multiprecision.h"

namespace irk {

template <class Real>
EndCheck finish(const System<Real>& system, const IntegratorOptions& options, const ErrorNorm<Real>& norm,
                State<Real>& state, Counters& counters) {
  if (system.errorPowers().isIndex3()) {
    const Outcome projected = VelocityProjection<Real>(system, options.derivatives, counters).apply(state);
    if (projected != Outcome::kSuccess) return {projected, "at the end: velocities cannot be projected on dg/dt = 0"};
  }
  const std::string violated = constraintViolation(system, state, norm.weights(), allowedDrift(options.tolerances));
  return violated.empty() ? EndCheck{} : EndCheck{Outcome::kDrift, violated};
}

std::string roundOffRemark(double size) {
  if (!(size > 0)) return {};
  std::ostringstream text;
  text.precision(2);
  text << "Newton's corrections end in round-off of the residual, up to " << size << " tolerances";
  return text.str();
}

#define IRK_FINISH(Real)                                                                                        \
  template EndCheck finish(const System<Real>&, const IntegratorOptions&, const ErrorNorm<Real>&, State<Real>&, \
                           Counters&);
IRK_FINISH(double)
IRK_FINISH(BigFloat)
#undef IRK_FINISH

}  // namespace irk
