// Unrolls loops over a few entries.
#pragma once

#include <algorithm>
#include <type_traits>

#include "irk/scalar.h"

namespace irk {

/// The most entries for which a loop over numbers of type Real is unrolled: `most` in double, 0 in multiprecision,
/// where each operation is a call, so that unrolled loops gain nothing and take time to compile.
template <class Real>
constexpr Index unrolledSizes(Index most) {
  return std::is_same_v<Real, double> ? most : 0;
}

/// Calls f(n). If n <= Most (at most 9), f gets n as a compile-time constant, so that the compiler unrolls the
/// loops in f; otherwise f gets n as a plain number. f is written once for both cases. Always inlined: what f captures
/// would else be stored and loaded again, which takes longer than a few entries.
template <Index Most, class F>
[[gnu::always_inline]] inline decltype(auto) withSize(Index n, const F& f) {
  static_assert(Most <= 9);
  if constexpr (Most == 0) return f(n);
  const auto at = [&](auto size) -> decltype(auto) {
    if constexpr (decltype(size)::value <= Most) {
      return f(size);
    } else {
      return f(n);
    }
  };
  switch (n) {
    case 1:
      return at(std::integral_constant<Index, 1>());
    case 2:
      return at(std::integral_constant<Index, 2>());
    case 3:
      return at(std::integral_constant<Index, 3>());
    case 4:
      return at(std::integral_constant<Index, 4>());
    case 5:
      return at(std::integral_constant<Index, 5>());
    case 6:
      return at(std::integral_constant<Index, 6>());
    case 7:
      return at(std::integral_constant<Index, 7>());
    case 8:
      return at(std::integral_constant<Index, 8>());
    case 9:
      return at(std::integral_constant<Index, 9>());
    default:
      return f(n);
  }
}

/// Copies n numbers that are few as a rule: up to nine without a call.
template <class Real>
[[gnu::always_inline]] inline void copyFew(const Real* from, Index n, Real* to) {
  withSize<unrolledSizes<Real>(9)>(n, [&](auto size) { std::copy_n(from, Index(size), to); });
}

}  // namespace irk
