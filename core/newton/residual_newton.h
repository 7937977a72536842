// Newton methods that stop on the residual: the paper's with its fallbacks, and full Newton.
#pragma once

#include "core/newton/newton.h"

namespace irk {

Strategy<NewtonKind> modifiedNewton();
Strategy<NewtonKind> modifiedOnlyNewton();
Strategy<NewtonKind> paperRuleNewton();
Strategy<NewtonKind> fullNewton();

}  // namespace irk
