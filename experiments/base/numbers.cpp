#include "experiments/base/numbers.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>

namespace irk {

double cellNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);  // std::from_chars accepts no plus sign
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  const bool number = error == std::errc() && end == text.data() + text.size();
  return number ? x : std::numeric_limits<double>::quiet_NaN();
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
