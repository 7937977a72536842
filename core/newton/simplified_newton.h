// Newton methods that stop on the increment: simplified Newton, and with Broyden's updates.
#pragma once

#include "core/newton/newton.h"

namespace irk {

Strategy<NewtonKind> simplifiedNewton();
Strategy<NewtonKind> broydenNewton();

}  // namespace irk
