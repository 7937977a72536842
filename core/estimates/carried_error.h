// The estimated error of a result, with its amplification by the motion.
#pragma once

#include <limits>
#include <string>

#include "irk/options.h"

namespace irk {

struct CarriedError {
  double size = std::numeric_limits<double>::quiet_NaN();  ///< in tolerances; NaN: unknown
  double amplification = 0;                                ///< `size` over the sum of the errors of the steps

  /// Why a result with this error is no success, in words; empty if it may be one.
  std::string doubt(const Tolerances& tolerances) const;
};

}  // namespace irk
