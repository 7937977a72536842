// Checks of a system and of a start. They run once, before the first step.
#pragma once

#include <string>

#include "irk/system.h"

namespace irk {

/// The functions that a problem has.
struct Declared {
  bool constraints = true;  ///< it has a function `constraints`
  bool switching = true;    ///< it has a function `switching`
};

/// Throws Misuse for negative sizes, for a system without unknowns, for more multipliers than algebraic unknowns,
/// and for constraints or switches without their functions. The message names the size and what is allowed.
void requireSizes(const Sizes& sizes, const Declared& declared = {});

/// Checks any system, also one that makeSystem has not made. Throws Misuse for null, for sizes as above, for row or
/// error powers of the wrong length, and for a scale that is neither empty nor > 0 in every component.
template <class Real>
void requireSystem(const System<Real>* system, const Vec<double>& scale);

/// Throws Misuse for a start whose sizes differ from the scene's, for a start or end time that is not finite, and for
/// an end before the start, and for a residual that reads v there though System::usesVelocity is false. Other numbers
/// of the start may be infinite or NaN: see notFinite.
template <class Real>
void requireStart(const System<Real>& system, const State<Real>& start, const Real& t_end);

/// Names the first number of u, v, x, w = (a, k, z), d that is not finite, e.g. "v[0] = inf"; empty if there is none.
template <class Real>
std::string notFinite(const State<Real>& start);

}  // namespace irk
