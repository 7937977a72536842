// The precision in which coefficients are constructed, read and analysed.
#pragma once

#include "irk/multiprecision.h"

namespace irk {

/// Digits more than the working digits: the construction loses at most 8 of them up to s = 100.
inline constexpr int kSpareDigits = 30;

/// The number of digits in tableau files that the program writes, and in the files of tableaus/data.
inline constexpr int kFileDigits = 50;

/// The digits in which tableaus are read and analysed.
inline constexpr int kAnalysisDigits = kFileDigits + kSpareDigits;

}  // namespace irk
