// Loops over a few entries, unrolled.
#pragma once

#include <type_traits>

#include "irk/scalar.h"

namespace irk {

/// f(n) with n a constant of the type where it is at most `Most` (itself at most 9), so that its loops
/// are unrolled; the same f with the number itself above. One text for both.
template <Index Most, class F>
decltype(auto) withSize(Index n, const F& f) {
  static_assert(Most <= 9);
  const auto at = [&](auto size) -> decltype(auto) {
    if constexpr (decltype(size)::value <= Most) {
      return f(size);
    } else {
      return f(n);
    }
  };
  switch (n) {
    case 1: return at(std::integral_constant<Index, 1>());
    case 2: return at(std::integral_constant<Index, 2>());
    case 3: return at(std::integral_constant<Index, 3>());
    case 4: return at(std::integral_constant<Index, 4>());
    case 5: return at(std::integral_constant<Index, 5>());
    case 6: return at(std::integral_constant<Index, 6>());
    case 7: return at(std::integral_constant<Index, 7>());
    case 8: return at(std::integral_constant<Index, 8>());
    case 9: return at(std::integral_constant<Index, 9>());
    default: return f(n);
  }
}

}  // namespace irk
