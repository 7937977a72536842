// Tells Boost.Math the precision of a BigFloat, which is known at run time only. To be included before Boost.Math's
// special functions and constants.
#pragma once

#include <boost/math/tools/precision.hpp>

#include "irk/multiprecision.h"

/// The bits of the working digits.
template <>
inline int boost::math::tools::digits<irk::BigFloat>() noexcept {
  int exponent = 0;
  static_cast<void>(frexp(std::numeric_limits<irk::BigFloat>::epsilon(), &exponent));
  return 2 - exponent;
}
