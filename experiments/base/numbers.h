// Numbers as text: one way out, one checked way in.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace irk {

/// `%.17g`, which reads back to the same bits; NaN is `nan`.
std::string numberText(double x);

/// A legal range with the words that messages use for it.
struct NumberRange {
  bool (*contains)(double);
  std::string_view text;
};
inline constexpr NumberRange kAnyNumber{[](double) { return true; }, "a number"};
inline constexpr NumberRange kPositive{[](double x) { return x > 0; }, "> 0"};
inline constexpr NumberRange kNotNegative{[](double x) { return x >= 0; }, ">= 0"};

/// Throws Misuse `place = 'text' ...: range` for text that is not a finite number in the range.
double parseNumber(std::string_view place, std::string_view text, const NumberRange& range);
std::int64_t parseInteger(std::string_view place, std::string_view text, std::int64_t min,
                          std::int64_t max);

/// A cell of a table: NaN for `nan` and for text that is no number.
double cellNumber(std::string_view text);

/// FNV-1a, 64 bits: stable across machines, unlike std::hash.
std::uint64_t fnv1a(std::string_view bytes);
std::string hexText(std::uint64_t x);

}  // namespace irk
