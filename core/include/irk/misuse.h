// Misuse: the exception for bad input, thrown before the first step. Numerical failures are values of Outcome
// (outcome.h).
#pragma once

#include <stdexcept>
#include <string>

namespace irk {

/// Thrown for input that can never work: an unknown id, a value out of range, an illegal combination,
/// a damaged file. The message names the place, the value and the allowed range. The program `irk` then exits
/// with status 2.
class Misuse : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace irk
