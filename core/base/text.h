// Names: look-ups, and helpers for messages of Misuse: the nearest known name, lists of names.
#pragma once

#include <algorithm>
#include <functional>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

#include "irk/misuse.h"

namespace irk {

/// The known name with the smallest edit distance to `given`; empty if no names are known.
std::string nearestName(std::string_view given, const std::vector<std::string>& known);

/// The message `unknown <kind> 'given'; did you mean 'nearest'? Known: a, b, c`.
std::string unknownName(std::string_view kind, std::string_view given, const std::vector<std::string>& known);

/// The element of `all` whose name is `given`; `name_of` is the member or the function that gives an element's name.
/// Throws Misuse with unknownName if there is none.
template <std::ranges::borrowed_range Range, class NameOf>
auto& entryNamed(std::string_view kind, std::string_view given, Range&& all, NameOf name_of) {
  const auto found = std::ranges::find(all, given, name_of);
  if (found != std::ranges::end(all)) return *found;
  std::vector<std::string> known;
  for (const auto& entry : all) known.emplace_back(std::invoke(name_of, entry));
  throw Misuse(unknownName(kind, given, known));
}

}  // namespace irk
