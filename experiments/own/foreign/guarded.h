// Arrays that another library writes, with room around them that shows what it writes outside.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "irk/scene_c.h"

namespace irk::own {

/// n numbers that a function gets to write.
class GuardedNumbers {
 public:
  /// `function` and `name` are those of messages: "irk_scene_rates", "f". Every number is that of `before` at its
  /// place; where `before` ends, one that says that nothing was written there.
  GuardedNumbers(std::string function, std::string name, std::size_t n, std::span<const double> before = {});
  double* data() { return numbers_.data() + kRoom; }
  std::span<const double> values() const { return {numbers_.data() + kRoom, n_}; }
  /// Throws Misuse if anything outside was written.
  void requireInside() const;
  /// The same, and if one of the numbers was not written.
  void requireWritten() const;
  /// Throws Misuse if one of the numbers is not finite.
  void requireFinite() const;

 private:
  static constexpr std::size_t kRoom = 64;

  std::string function_, name_;
  std::size_t n_;
  std::vector<double> numbers_;
};

/// A text that a function gets to write.
class GuardedText {
 public:
  explicit GuardedText(std::string function, const std::string& before = {});
  char* data() { return text_.data(); }
  /// What was written, without blanks at its end. Throws Misuse if it is longer than IRK_SCENE_TEXT - 1, or no line.
  std::string text() const;

 private:
  static constexpr std::size_t kRoom = 256;

  std::string function_;
  std::vector<char> text_;
};

}  // namespace irk::own
