// Options of a system: the formulation of its position constraints, the scaling of their rows, and the treatment of
// switches.
#pragma once

#include "irk/system.h"

namespace irk {

/// The form in which position constraints g(t, u) = 0 enter the system.
enum class Formulation {
  kIndex2,             ///< dg/dt = 0; positions drift
  kIndex3,             ///< g = 0
  kGgl,                ///< g = 0 and dg/dt = 0 with u' = v + G^T mu; Gear, Gupta, Leimkuhler 1985
  kIndex2Projected,    ///< dg/dt = 0; after each step v is projected onto it, HW II (VII.2)
  kIndex1,             ///< d2g/dt2 = 0; positions and velocities drift
  kFirstOrder,         ///< y' = f(t, y) with y = (u, v, x); see firstOrderForm in irk/problem.h
  kFirstOrderPerStep,  ///< the same with M factorized once per step; see MassFactors in irk/problem.h
};

/// Whether constraint rows are multiplied by 1/h^power (paper, section 4). kOff exists to show what scaling gains.
enum class ConstraintScaling { kOn, kOff };

/// How makeSystem turns a problem into a system.
struct SystemOptions {
  Formulation formulation = Formulation::kIndex2;
  ConstraintScaling scaling = ConstraintScaling::kOn;
  /// Has no effect on a problem without switches.
  Discontinuity discontinuity = Discontinuity::kLocate;
  /// Numbers of the position constraints that are left out because they follow from the others, ascending, from 0 on:
  /// dependentConstraints in irk/dependent_constraints.h finds them. Their rows become z_i = 0, so that their
  /// multipliers are 0; the others carry the whole force.
  std::vector<Index> left_out = {};
};

/// Throws Misuse for values that the enumerations and the axis `discontinuity` do not have.
void validate(const SystemOptions& options);

}  // namespace irk
