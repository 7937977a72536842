// Whether a run that has reached its end may be called a success, as far as its last state shows.
#pragma once

#include <string>

#include "core/stages/error_norm.h"
#include "irk/outcome.h"

namespace irk {

/// kSuccess or kDrift, and why; one line.
struct EndCheck {
  Outcome outcome = Outcome::kSuccess;
  std::string detail;
};

/// Checks the position constraints (core/derivatives/constraint_check.h). The norm has the weights of this state. Its
/// evaluations are not counted.
template <class Real>
EndCheck checkEnd(const System<Real>& system, const State<Real>& state, const ErrorNorm<Real>& norm,
                  const Tolerances& tolerances);

/// The remark on a success whose Newton corrections ended in round-off of the residual, of up to `size` tolerances;
/// empty for 0.
std::string roundOffRemark(double size);

}  // namespace irk
