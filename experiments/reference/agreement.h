// The number of digits on which several computations of one number agree.
#pragma once

#include <span>
#include <string>

#include "irk/multiprecision.h"

namespace irk {

struct AgreedValue {
  BigFloat value;
  double accuracy;  ///< > 0, absolute, one significant digit
};

/// The last of `runs` (at least two; the best one last). Its accuracy is the largest difference between any two, but
/// at least `least` (> 0), rounded up.
AgreedValue agreed(std::span<const BigFloat> runs, double least);

/// x > 0 rounded up to one significant digit: 2.3e-20 gives 3e-20.
double roundedUp(double x);

/// The digits that the accuracy guarantees and one more; at most 40 significant ones.
std::string decimalText(const BigFloat& value, double accuracy);

}  // namespace irk
