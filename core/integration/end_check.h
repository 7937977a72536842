// Whether a run that has reached its end may be called a success, as far as its last state shows.
#pragma once

#include <string>

#include "core/stages/error_norm.h"
#include "irk/outcome.h"
#include "irk/statistics.h"

namespace irk {

/// kSuccess or kDrift, and why; one line.
struct EndCheck {
  Outcome outcome = Outcome::kSuccess;
  std::string detail;
};

/// Ends a run with variable steps: projects the velocities of the index-3 formulation, then checks the position
/// constraints (core/derivatives/constraint_check.h). The norm has the weights of `state`. The evaluations of the check
/// are not counted.
template <class Real>
EndCheck finish(const System<Real>& system, const IntegratorOptions& options, const ErrorNorm<Real>& norm,
                State<Real>& state, Counters& counters);

/// The remark on a success whose Newton corrections ended in round-off of the residual, of up to `size` tolerances;
/// empty for 0.
std::string roundOffRemark(double size);

}  // namespace irk
