// Ids of strategies: values of an axis whose choices behave differently, and which others can extend.
#pragma once

#include <compare>
#include <string_view>

namespace irk {

/// An id of the axis `Axis`, which derives from it and names the ids that come with the library. The text is of static
/// storage duration: a literal, or the catalogue's. Ids are compared by their text.
template <class Axis>
struct StrategyId {
  std::string_view id;

  friend constexpr bool operator==(const StrategyId&, const StrategyId&) = default;
  friend constexpr std::strong_ordering operator<=>(const StrategyId&, const StrategyId&) = default;
};

}  // namespace irk
