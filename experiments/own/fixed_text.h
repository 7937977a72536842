// A message that is written by a signal handler.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace irk::own {

/// Made before the signal, because a handler may not allocate. The code that crashes may have overwritten it: a static
/// object less likely than one in the heap.
class FixedText {
 public:
  /// Longer texts are cut.
  void set(std::string_view text) {
    size_ = std::min(text.size(), text_.size());
    std::copy_n(text.begin(), size_, text_.begin());
  }
  void print() const {
    const auto written = write(STDERR_FILENO, text_.data(), size_);
    static_cast<void>(written);  // nothing is left to be done
  }

 private:
  std::array<char, 2000> text_{};
  std::size_t size_ = 0;
};

}  // namespace irk::own
