// Numbers as text: one way out, one checked way in.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/range.h"

namespace irk {

/// The shortest text that reads back to the same bits: 0.1, 1e-06; NaN is `nan`.
std::string numberText(double x);

/// Throws Misuse `place = 'text' ...: range` for text that is not a finite number of the range.
double parseNumber(std::string_view place, std::string_view text, const Range& range);
/// For text that is not an integer of the range; `1e3` is none.
std::int64_t parseInteger(std::string_view place, std::string_view text, const Range& range);

/// Throws Misuse `place = x is out of range: range`.
void requireInRange(std::string_view place, double x, const Range& range);

}  // namespace irk
