// Which options go together, and with which methods and systems: one table.
#pragma once

#include <cstddef>
#include <vector>

#include "core/stages/scheme_list.h"
#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// Throws Misuse for options that contradict each other whatever the method and the system: "illegal combination: ",
/// both ids, and the reason.
void requireLegal(const IntegratorOptions& options);

/// Throws Misuse for combinations that a method, the system, the scalar or a strategy's needs forbid. What only a
/// computation shows is refused by it: `eigen` with a defective A, a problem that has no regularisation for `smooth`.
/// `start`: the member of `schemes` to begin with.
template <class Real>
void requireLegal(const IntegratorOptions& options, const System<Real>& system, const SchemeList<Real>& schemes,
                  std::size_t start);

}  // namespace irk
