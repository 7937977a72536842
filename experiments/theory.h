// What theory says about the order of convergence, per family, kind of system and component.
#pragma once

#include <optional>
#include <string_view>

#include "core/scalar.h"

namespace irk {

enum class SystemKind { kOde, kIndex2, kIndex3 };

/// Exponent of the global error of component 'u', 'v', 'x' or 'z' at a fixed time with constant
/// steps. Nothing where no order is known (or the family cannot treat algebraic unknowns).
/// ODE: Hairer & Wanner II (1996), IV.5. Mechanical systems of index 2 and 3: Hairer, Lubich &
/// Roche, LNM 1409 (1989); Jay, BIT 33 (1993); Gauss and Radau IA for s <= 5 measured in 60 digits.
std::optional<double> theoreticalOrder(std::string_view family, Index s, SystemKind kind,
                                       char component);

}  // namespace irk
