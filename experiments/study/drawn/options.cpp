#include "experiments/study/drawn/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

#include "experiments/base/numbers.h"
#include "experiments/runs/fields.h"

namespace irk::audit {
namespace {

constexpr double kChangesOption = 0.25;
constexpr double kChangesTolerance = 0.3;
constexpr Index kMostTolerance = 2, kLeastTolerance = 13;  // 1e-2 to 1e-13

// In the order of kNames. Strategies that only a claim needs are not drawn.
constexpr std::string_view kNames[] = {"norm", "estimate", "control", "newton", "predictor", "multipliers"};
using Values = std::array<std::string_view, 4>;  // up to four
constexpr Values kValues[] = {{"mixed", "absolute"},
                              {"richardson", "doubling", "doubling_scalar", "embedded"},
                              {"predictive", "paper", "hotint"},
                              {"simplified", "broyden", "modified", "full"},
                              {"extrapolated", "previous", "acceleration"},
                              {"consistent", "stages"}};
static_assert(std::size(kNames) == std::size(kValues));

}  // namespace

void drawOptions(Dice& dice, RunSpec& spec, const std::function<bool(const RunSpec&)>& isLegal) {
  for (std::size_t i = 0; i < std::size(kNames); ++i) {
    const bool changes = dice.chance(kChangesOption);
    const auto count = std::find(kValues[i].begin(), kValues[i].end(), "") - kValues[i].begin();
    const auto value = kValues[i][static_cast<std::size_t>(dice.below(count))];
    if (!changes) continue;
    RunSpec changed = spec;
    findField(kNames[i]).set(changed, value);
    if (isLegal(changed)) spec = changed;
  }
}

void drawTolerances(Dice& dice, RunSpec& spec) {
  const Index atol = dice.between(kMostTolerance, kLeastTolerance);
  const bool differ = dice.chance(kChangesTolerance);
  const Index by = dice.between(1, 3);
  const bool stricter = dice.chance(0.5);
  const Index rtol = differ ? std::clamp(stricter ? atol + by : atol - by, kMostTolerance, kLeastTolerance) : atol;
  findField("rtol").set(spec, fmt::format("1e-{}", rtol));
  findField("atol").set(spec, fmt::format("1e-{}", atol));
}

double drawnEnd(Dice& dice, double t_end) {
  constexpr double kShortest = 0.2, kLongest = 2;
  const double factor = kShortest * std::pow(kLongest / kShortest, dice.uniform());
  return cellNumber(fmt::format("{:.3g}", factor * t_end));
}

}  // namespace irk::audit
