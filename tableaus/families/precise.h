// The precision that coefficients are constructed, read and analysed in.
#pragma once

#include "irk/multiprecision.h"

namespace irk {

/// 30 digits more than mp50: the construction loses at most 8 of them up to s = 100.
using mp80 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<80>,
                                           boost::multiprecision::et_off>;

/// The same for mp100.
using mp130 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<130>,
                                            boost::multiprecision::et_off>;

/// Digits that tableau files are written with and that the suite's own files promise.
inline constexpr int kFileDigits = 50;

}  // namespace irk
