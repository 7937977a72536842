// Whether a run that has reached its end may be called a success, as far as its last state shows.
#pragma once

#include <string>

#include "core/stages/error_norm.h"
#include "irk/outcome.h"

namespace irk {

/// kSuccess, kDrift or kInaccurate, and why; one line.
struct EndCheck {
  Outcome outcome = Outcome::kSuccess;
  std::string detail;
};

/// Checks the position constraints and, if `bounds`, that no x is negative where it cannot be
/// (core/derivatives/constraint_check.h). The norm has the weights of this state. Its evaluations are not counted.
template <class Real>
EndCheck checkEnd(const System<Real>& system, const State<Real>& state, const ErrorNorm<Real>& norm,
                  const Tolerances& tolerances, bool bounds);

/// The remark on a success whose Newton corrections ended in round-off of the residual, of up to `size` tolerances;
/// empty for 0.
std::string roundOffRemark(double size);

}  // namespace irk
