#include "core/integration/end_check.h"

#include <sstream>

#include "core/derivatives/constraint_check.h"
#include "irk/multiprecision.h"

namespace irk {

template <class Real>
EndCheck checkEnd(const System<Real>& system, const State<Real>& state, const ErrorNorm<Real>& norm,
                  const Tolerances& tolerances) {
  const std::string violated = constraintViolation(system, state, norm.weights(), allowedDrift(tolerances));
  return violated.empty() ? EndCheck{} : EndCheck{Outcome::kDrift, violated};
}

std::string roundOffRemark(double size) {
  if (!(size > 0)) return {};
  std::ostringstream text;
  text.precision(2);
  text << "Newton's corrections end in round-off of the residual, up to " << size << " tolerances";
  return text.str();
}

#define IRK_CHECK(Real) \
  template EndCheck checkEnd(const System<Real>&, const State<Real>&, const ErrorNorm<Real>&, const Tolerances&);
IRK_CHECK(double)
IRK_CHECK(mp50)
IRK_CHECK(mp100)
#undef IRK_CHECK

}  // namespace irk
