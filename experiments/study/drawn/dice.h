// Random choices that are the same on every machine.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string_view>

#include "irk/scalar.h"

namespace irk::audit {

/// A sequence of random choices that is determined by a text. The C++ standard fixes the engine's bits but not the
/// results of its distributions, so this class maps bits to choices itself.
class Dice {
 public:
  /// The same text gives the same choices.
  explicit Dice(std::string_view text);

  /// Uniform in [0, 1), 53 bits.
  double uniform();
  /// Uniform in 0 .. count - 1. Requires count > 0.
  Index below(Index count);
  /// Uniform in first .. last.
  Index between(Index first, Index last) { return first + below(last - first + 1); }
  /// True with this probability.
  bool chance(double probability) { return uniform() < probability; }
  /// +1 or -1.
  double sign() { return chance(0.5) ? 1 : -1; }
  /// An index, with probability proportional to its weight (>= 0, not all zero).
  Index weighted(std::span<const double> weights);

 private:
  std::mt19937_64 engine_;
};

}  // namespace irk::audit
