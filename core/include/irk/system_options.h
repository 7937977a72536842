// Which system is made of a problem: the formulation of its constraints, the scaling of their rows, and what is done
// at switches.
#pragma once

#include "irk/system.h"

namespace irk {

/// How position constraints g(t, u) = 0 enter. Design, section 3.
enum class Formulation {
  kIndex2,           ///< dg/dt = 0
  kIndex3,           ///< g = 0
  kGgl,              ///< g = 0 and dg/dt = 0 with u' = v + G^T mu; Gear, Gupta, Leimkuhler 1985
  kIndex2Projected,  ///< dg/dt = 0, v projected on it after each step; HW II (VII.2)
  kIndex1,           ///< d2g/dt2 = 0
  kFirstOrder,       ///< y' = f(t, y), y = (u, v, x); irk/problem.h
};

/// Whether constraint rows are multiplied by 1/h^power (paper, section 4). Off only to show why.
enum class ConstraintScaling { kOn, kOff };

/// Which system is made of a problem.
struct SystemOptions {
  Formulation formulation = Formulation::kIndex2;
  ConstraintScaling scaling = ConstraintScaling::kOn;
  /// Without effect on a problem that declares no switches.
  Discontinuity discontinuity = Discontinuity::kLocate;
};

}  // namespace irk
