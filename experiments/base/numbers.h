// Numbers in table cells, and hashes for keys.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/number_text.h"

namespace irk {

/// The number in a table cell; NaN for `nan` and for text that is no number.
double cellNumber(std::string_view text);

/// The FNV-1a hash, 64 bits. Unlike std::hash it is the same on every machine.
std::uint64_t fnv1a(std::string_view bytes);
std::string hexText(std::uint64_t x);

}  // namespace irk
