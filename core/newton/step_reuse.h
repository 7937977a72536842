// Newton methods that keep their Jacobian for another step by rule, whatever the contraction is: they measure what
// reuse gains.
#pragma once

#include <vector>

#include "core/newton/newton.h"

namespace irk {

/// `modified` and `broyden`, each with a new Jacobian in every attempted step, and each with one that is kept only
/// where the step size has changed.
std::vector<Strategy<NewtonKind>> newtonWithReuseByStep();

}  // namespace irk
