#include "experiments/base/numbers.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "irk/misuse.h"

namespace irk {
namespace {

// std::from_chars reads no leading '+', which people write in exponents and numbers alike.
template <class Number>
bool readWhole(std::string_view text, Number& x) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::string numberText(double x) { return std::isnan(x) ? "nan" : fmt::format("{:.17g}", x); }

double parseNumber(std::string_view place, std::string_view text, const NumberRange& range) {
  double x = 0;
  if (!readWhole(text, x) || !std::isfinite(x)) {
    throw Misuse(fmt::format("{} = '{}' is not a finite number: {}", place, text, range.text));
  }
  if (!range.contains(x)) {
    throw Misuse(fmt::format("{} = {} is out of range: {}", place, text, range.text));
  }
  return x;
}

std::int64_t parseInteger(std::string_view place, std::string_view text, std::int64_t min,
                          std::int64_t max) {
  std::int64_t x = 0;
  if (!readWhole(text, x) || x < min || x > max) {
    throw Misuse(
        fmt::format("{} = '{}' is out of range: an integer from {} to {}", place, text, min, max));
  }
  return x;
}

double cellNumber(std::string_view text) {
  double x = 0;
  return readWhole(text, x) ? x : std::numeric_limits<double>::quiet_NaN();
}

std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;  // offset basis and prime of the 64-bit FNV-1a
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  }
  return hash;
}

std::string hexText(std::uint64_t x) { return fmt::format("{:016x}", x); }

}  // namespace irk
