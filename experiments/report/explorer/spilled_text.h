// A long text that is put together piece by piece.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>

#include "experiments/store/spill_file.h"

namespace irk {

/// Memory holds kHeld bytes of it; the rest is in a temporary file. Throws Failure.
class SpilledText {
 public:
  static constexpr std::size_t kHeld = 1 << 16;

  void append(std::string_view text);
  void write(std::ostream& out) const;

 private:
  std::string held_;  // the end
  std::unique_ptr<store::SpillFile> file_;
  std::uint64_t in_file_ = 0;  // bytes
};

}  // namespace irk
