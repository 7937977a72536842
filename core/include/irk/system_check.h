// Checks of a system and of a start. They run once, before the first step.
#pragma once

#include <string>
#include <vector>

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

/// Throws Misuse for a scale that is neither empty nor one finite number > 0 per component (u, v, x, z).
void requireScale(const Vec<double>& scale, const Sizes& sizes);

/// Throws Misuse for times that are not finite or not ascending.
template <class Real>
void requireTimes(const std::vector<Real>& times);

/// Throws Misuse for a state of other sizes than `sizes`. `what`: where it comes from, for the message.
template <class Real>
void requireState(const char* what, const State<Real>& state, const Sizes& sizes);

/// Checks any system, also one that makeSystem has not made. Throws Misuse for null, for sizes as above, for row or
/// error powers of the wrong length or other than 0 to 2, and for a scale as above.
template <class Real>
void requireSystem(const System<Real>* system, const Vec<double>& scale);

/// Throws Misuse for a start whose sizes differ from the scene's, for a start or end time that is not finite, for an
/// end before the start, for times of the system as above, and for a residual that reads v there though
/// System::usesVelocity is false. Other numbers of the start may be infinite or NaN: see notFinite.
template <class Real>
void requireStart(const System<Real>& system, const State<Real>& start, const Real& t_end);

/// Names the first number of u, v, x, w = (a, k, z), d that is not finite, e.g. "v[0] = inf"; empty if there is none.
template <class Real>
std::string notFinite(const State<Real>& start);

}  // namespace irk
