#include "experiments/own/foreign/guarded.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>

#include "irk/misuse.h"

namespace irk::own {
namespace {

// A NaN with a payload of its own, which no function computes.
constexpr double kUntouched = std::bit_cast<double>(std::uint64_t{0x7ff8'4321'8765'cba9});
constexpr char kUntouchedLetter = '\x7f';

bool isUntouchedNumber(double x) { return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(kUntouched); }

}  // namespace

GuardedNumbers::GuardedNumbers(std::string function, std::string name, std::size_t n, std::span<const double> before)
    : function_(std::move(function)), name_(std::move(name)), n_(n), numbers_(n + 2 * kRoom, kUntouched) {
  std::copy_n(before.begin(), std::min(n, before.size()), numbers_.begin() + kRoom);
}

void GuardedNumbers::requireInside() const {
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    if ((i >= kRoom && i < kRoom + n_) || isUntouchedNumber(numbers_[i])) continue;
    throw Misuse(fmt::format("{} writes {}[{}], but {} has {} numbers", function_, name_,
                             static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(kRoom), name_, n_));
  }
}

void GuardedNumbers::requireWritten() const {
  requireInside();
  for (std::size_t i = 0; i < n_; ++i) {
    if (!isUntouchedNumber(numbers_[kRoom + i])) continue;
    throw Misuse(fmt::format("{} does not write {}[{}]; {} has {} numbers", function_, name_, i, name_, n_));
  }
}

void GuardedNumbers::requireFinite() const {
  for (std::size_t i = 0; i < n_; ++i) {
    if (std::isfinite(numbers_[kRoom + i])) continue;
    throw Misuse(fmt::format("{}: {}[{}] is {}", function_, name_, i, numbers_[kRoom + i]));
  }
}

GuardedText::GuardedText(std::string function, const std::string& before)
    : function_(std::move(function)), text_(IRK_SCENE_TEXT + kRoom, kUntouchedLetter) {
  std::fill_n(text_.begin(), IRK_SCENE_TEXT, '\0');
  std::copy_n(before.begin(), std::min<std::size_t>(before.size(), IRK_SCENE_TEXT - 1), text_.begin());
}

std::string GuardedText::text() const {
  const auto end = std::find(text_.begin(), text_.begin() + IRK_SCENE_TEXT, '\0');
  const bool inside =
      std::all_of(text_.begin() + IRK_SCENE_TEXT, text_.end(), [](char letter) { return letter == kUntouchedLetter; });
  if (!inside || end == text_.begin() + IRK_SCENE_TEXT) {
    throw Misuse(
        fmt::format("{} writes a text without a 0 at its end, or a longer one than {} characters (IRK_SCENE_TEXT)",
                    function_, IRK_SCENE_TEXT - 1));
  }
  std::string text(text_.begin(), end);
  while (!text.empty() && text.back() == ' ') text.pop_back();  // Fortran fills texts with blanks
  const bool line = std::none_of(text.begin(), text.end(),
                                 [](char letter) { return std::iscntrl(static_cast<unsigned char>(letter)) != 0; });
  if (!line) throw Misuse(function_ + " writes a text with control characters: one line is expected");
  return text;
}

}  // namespace irk::own
