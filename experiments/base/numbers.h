// Numbers in tables and keys.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/number_text.h"

namespace irk {

/// A cell of a table: NaN for `nan` and for text that is no number.
double cellNumber(std::string_view text);

/// FNV-1a, 64 bits: stable across machines, unlike std::hash.
std::uint64_t fnv1a(std::string_view bytes);
std::string hexText(std::uint64_t x);

}  // namespace irk
