// The table of rules: which options work together, and with which methods and systems.
#pragma once

#include <cstddef>
#include <vector>

#include "core/stages/scheme_list.h"
#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// Throws Misuse for options that exclude each other with any method and system. The message is
/// "illegal combination: ", both ids, and the reason.
void requireLegal(const IntegratorOptions& options);

/// Throws Misuse for combinations that do not work with the method, the system, the scalar or the needs of a strategy.
/// Where only a computation can show this, the computation throws: `eigen` with a defective A, `smooth` with a problem
/// that has no regularisation. `start`: index of the member of `schemes` to begin with.
template <class Real>
void requireLegal(const IntegratorOptions& options, const System<Real>& system, const SchemeList<Real>& schemes,
                  std::size_t start);

/// The options that an integration with these options has, after all of these checks: with fixed steps there is no
/// estimate and no tolerance, and Newton's method iterates to round-off of the solution's magnitude; small systems have
/// one thread.
template <class Real>
IntegratorOptions legalOptions(IntegratorOptions options, const System<Real>& system, const SchemeList<Real>& schemes,
                               std::size_t start);

}  // namespace irk
