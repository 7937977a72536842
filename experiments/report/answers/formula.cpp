#include "experiments/report/answers/formula.h"

#include <fmt/format.h>

#include <cmath>

namespace irk::report {
namespace {

constexpr Index kMostStages = 20;

// slope s + constant
struct Line {
  int slope = 0, constant = 0;
  bool operator==(const Line&) const = default;
  int at(Index s) const { return slope * static_cast<int>(s) + constant; }
};

std::optional<int> orderAt(std::string_view family, Index s, SystemKind kind, char component) {
  const auto order = theoreticalOrder(family, s, kind, component);
  return order ? std::optional(static_cast<int>(std::lround(order->order))) : std::nullopt;
}

// Through the orders of `s` and `s - 2` stages.
std::optional<Line> lineAt(std::string_view family, Index s, SystemKind kind, char component) {
  const auto high = orderAt(family, s, kind, component), low = orderAt(family, s - 2, kind, component);
  if (!high || !low || (*high - *low) % 2 != 0) return {};
  const int slope = (*high - *low) / 2;
  return Line{slope, *high - slope * static_cast<int>(s)};
}

std::string textOf(const Line& line) {
  if (line.slope == 0)
    return fmt::format("{}", line.constant).replace(0, line.constant < 0, line.constant < 0 ? "−" : "");
  const std::string s = line.slope == 1 ? "s" : fmt::format("{}s", line.slope);
  if (line.constant == 0) return s;
  return fmt::format("{} {} {}", s, line.constant > 0 ? "+" : "−", std::abs(line.constant));
}

}  // namespace

std::optional<OrderFormula> orderFormula(std::string_view family, SystemKind kind, char component) {
  const auto even = lineAt(family, kMostStages, kind, component),
             odd = lineAt(family, kMostStages - 1, kind, component);
  if (!even || !odd) return {};
  OrderFormula formula{textOf(*even), true};
  if (*odd != *even) formula.text += "; odd s: " + textOf(*odd);
  for (Index s = family.starts_with("lobatto") ? 2 : 1; s <= kMostStages; ++s) {
    const auto order = theoreticalOrder(family, s, kind, component);
    const auto value = orderAt(family, s, kind, component);
    if (!value) return {};
    if (order->source != "theorem") formula.theorem = false;
    if (*value <= 0) formula.divergent = s;
    if (*value == (s % 2 == 0 ? *even : *odd).at(s)) continue;
    formula.text += fmt::format("; s = {}: {}", s, textOf({0, *value}));
  }
  return formula;
}

}  // namespace irk::report
