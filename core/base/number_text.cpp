#include "core/base/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

#include "irk/misuse.h"

namespace irk {
namespace {

// std::from_chars rejects a leading '+' of a number, which people do write.
template <class Number>
bool readWhole(std::string_view text, Number& x) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  return error == std::errc() && end == text.data() + text.size();
}

[[noreturn]] void refuse(std::string_view place, std::string_view value, std::string_view reason,
                         const std::string& range) {
  std::string message(place);
  message.append(" = ").append(value).append(" ").append(reason).append(": ").append(range);
  throw Misuse(message);
}

// 1000000000000 where integers are expected, not 1e+12.
std::string textIn(const Range& range, double x) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  const bool integer = range.whole && x == std::floor(x) && std::abs(x) <= kExact;
  return integer ? std::to_string(static_cast<std::int64_t>(x)) : numberText(x);
}

std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

}  // namespace

std::string numberText(double x) {
  if (std::isnan(x)) return "nan";  // std::to_chars may write a sign
  std::array<char, 32> text;
  const auto written = std::to_chars(text.data(), text.data() + text.size(), x);
  return {text.data(), written.ptr};
}

std::string Range::text() const {
  constexpr Range kAll;
  if (whole) return "an integer from " + textIn(*this, least) + " to " + textIn(*this, most);
  const bool bounded_below = least != kAll.least, bounded_above = most != kAll.most;
  const std::string lower = least_excluded ? "<" : "<=", upper = most_excluded ? "<" : "<=";
  if (bounded_below && bounded_above) {
    return numberText(least) + " " + lower + " x " + upper + " " + numberText(most);
  }
  if (bounded_below) return (least_excluded ? "> " : ">= ") + numberText(least);
  if (bounded_above) return upper + " " + numberText(most);
  return "a number";
}

double parseNumber(std::string_view place, std::string_view text, const Range& range) {
  double x = 0;
  if (!readWhole(text, x) || !std::isfinite(x)) {
    refuse(place, quoted(text), "is not a finite number", range.text());
  }
  if (!range.contains(x)) refuse(place, text, "is out of range", range.text());
  return x;
}

std::int64_t parseInteger(std::string_view place, std::string_view text, const Range& range) {
  std::int64_t x = 0;
  if (!readWhole(text, x) || !range.contains(static_cast<double>(x))) {
    refuse(place, quoted(text), "is out of range", range.text());
  }
  return x;
}

void requireInRange(std::string_view place, double x, const Range& range) {
  if (!range.contains(x)) refuse(place, textIn(range, x), "is out of range", range.text());
}

}  // namespace irk
