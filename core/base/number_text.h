// Writes numbers as text, and reads them with a check of their range.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/range.h"

namespace irk {

/// The shortest text that reads back to the same bits: 0.1, 1e-06; NaN is `nan`.
std::string numberText(double x);

/// Reads a number. Throws Misuse `place = 'text' ...: range` unless the text is a finite number within the range.
double parseNumber(std::string_view place, std::string_view text, const Range& range);
/// Reads an integer; throws likewise. Notations such as `1e3` are not accepted.
std::int64_t parseInteger(std::string_view place, std::string_view text, const Range& range);

/// Throws Misuse `place = x is out of range: range`.
void requireInRange(std::string_view place, double x, const Range& range);

}  // namespace irk
