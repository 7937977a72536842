// Misuse: bad input found before the first step. Outcomes of numerics are enums (outcome.h).
#pragma once

#include <stdexcept>
#include <string>

namespace irk {

/// Thrown for input that can never work: an unknown id, a value out of range, an illegal combination,
/// a damaged file. The message names the place, the value and the allowed range. Exit status 2.
class Misuse : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace irk
