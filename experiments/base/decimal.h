// Decimal text as a number of any scalar.
#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <type_traits>

#include "irk/multiprecision.h"

namespace irk {

/// All digits of a decimal text. Throws std::runtime_error in multiprecision if it is no number.
template <class Real>
Real decimalNumber(const std::string& text) {
  if constexpr (std::is_same_v<Real, double>) {
    return std::strtod(text.c_str(), nullptr);
  } else {
    return Real(text);
  }
}

/// The decimal number that was meant by a double: the shortest one that rounds to it. So an end
/// time of 0.3 is 3/10 in every precision, as the scenes' parameters are.
template <class Real>
Real decimalNumber(double x) {
  return decimalNumber<Real>(fmt::format("{}", x));
}

}  // namespace irk
