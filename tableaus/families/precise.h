// The precision in which coefficients are constructed, read and analysed.
#pragma once

#include "irk/multiprecision.h"

namespace irk {

/// 30 digits more than mp50: the construction loses at most 8 of them up to s = 100.
using mp80 = BigFloat<80>;

/// The same for mp100.
using mp130 = BigFloat<130>;

/// The number of digits in tableau files that the program writes, and in the files of tableaus/data.
inline constexpr int kFileDigits = 50;

}  // namespace irk
