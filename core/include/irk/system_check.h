// What a system and a start must be before an integration: checked once, so that no step has to ask.
#pragma once

#include <string>

#include "irk/system.h"

namespace irk {

/// What a problem declares beside its sizes.
struct Declared {
  bool constraints = true;  ///< a function of position constraints
  bool switching = true;    ///< switching functions
};

/// Throws Misuse, naming the number and what is allowed: negative sizes, no unknowns, more multipliers than algebraic
/// unknowns, constraints or switches without their functions.
void requireSizes(const Sizes& sizes, const Declared& declared = {});

/// Also for systems that are made by hand: Misuse for null, for sizes as above, for powers of another number of rows or
/// components. `scale` is empty or has a number > 0 for each component.
template <class Real>
void requireSystem(const System<Real>* system, const Vec<double>& scale);

/// Throws Misuse for a start of other sizes than the scene's, for a start or an end at no finite time, and for an end
/// before the start.
template <class Real>
void requireStart(const System<Real>& system, const State<Real>& start, const Real& t_end);

/// Empty, or the first number of u, v, x, (a, k, z), d that is not finite: "v[0] = inf".
template <class Real>
std::string notFinite(const State<Real>& start);

}  // namespace irk
