#include "experiments/reference/agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ios>

namespace irk {
namespace {

constexpr int kMaxDigits = 40;

// The exponent of a number, read from scientific notation: a logarithm is off by one next to a power of ten.
int exponentOf(const std::string& text) { return std::atoi(text.c_str() + text.find('e') + 1); }

}  // namespace

double roundedUp(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)));
  // x may be a multiple of the unit up to a few eps: 3e-20 must not become 4e-20.
  const double digit = std::ceil(x / unit * (1 - 1e-12));
  return std::strtod(fmt::format("{:.0e}", digit * unit).c_str(), nullptr);
}

AgreedValue agreed(std::span<const BigFloat> runs, double least) {
  const auto [smallest, largest] = std::minmax_element(runs.begin(), runs.end());
  const auto spread = static_cast<double>(BigFloat(*largest - *smallest));
  return {runs.back(), roundedUp(std::max(spread, least))};
}

std::string decimalText(const BigFloat& value, double accuracy) {
  if (abs(value) < BigFloat(accuracy) / 2) return "0";  // not even its first digit is known
  constexpr int kGuard = 1;
  const int last = exponentOf(fmt::format("{:.0e}", accuracy)) - kGuard;  // exponent of the last digit
  const int first = exponentOf(value.str(kMaxDigits, std::ios::scientific));
  const int digits = std::clamp(first - last + 1, 2, kMaxDigits);
  const bool plain = first >= -3 && first < digits - 1;
  // Both count the digits behind the point; 0 would select all digits.
  return plain ? value.str(digits - 1 - first, std::ios::fixed) : value.str(digits - 1, std::ios::scientific);
}

}  // namespace irk
