#include "experiments/study/drawn/dice.h"

#include <numeric>

#include "experiments/base/numbers.h"

namespace irk::audit {

Dice::Dice(std::string_view text) : engine_(fnv1a(text)) {}

double Dice::uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

Index Dice::below(Index count) { return static_cast<Index>(uniform() * static_cast<double>(count)); }

Index Dice::weighted(std::span<const double> weights) {
  double left = uniform() * std::accumulate(weights.begin(), weights.end(), 0.0);
  Index last = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] <= 0) continue;
    last = static_cast<Index>(i);
    left -= weights[i];
    if (left < 0) break;
  }
  return last;
}

}  // namespace irk::audit
