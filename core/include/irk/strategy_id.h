// Ids of strategies: the values of an axis whose choices differ in behaviour, and to which users can add.
#pragma once

#include <compare>
#include <string_view>

namespace irk {

/// An id of the axis `Axis`. The axis derives from this struct and names the ids that come with the library. The text
/// has static storage duration: a literal, or the catalogue's copy. Ids are compared by their text.
template <class Axis>
struct StrategyId {
  std::string_view id;

  friend constexpr bool operator==(const StrategyId&, const StrategyId&) = default;
  friend constexpr std::strong_ordering operator<=>(const StrategyId&, const StrategyId&) = default;
};

}  // namespace irk
