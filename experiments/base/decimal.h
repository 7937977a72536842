// Decimal text as a number of any scalar.
#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <type_traits>

#include "irk/multiprecision.h"

namespace irk {

/// The number that a decimal text stands for, with all its digits. In multiprecision throws std::runtime_error if the
/// text is no number.
template <class Real>
Real decimalNumber(const std::string& text) {
  if constexpr (std::is_same_v<Real, double>) {
    return std::strtod(text.c_str(), nullptr);
  } else {
    return Real(text);
  }
}

/// The shortest decimal number that rounds to this double, as a Real. An end time of 0.3 is thus 3/10 in every
/// precision, as the scenes' parameters are.
template <class Real>
Real decimalNumber(double x) {
  return decimalNumber<Real>(fmt::format("{}", x));
}

}  // namespace irk
