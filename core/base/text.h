// Helpers for messages of Misuse: the nearest known name, lists of names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace irk {

/// The known name with the smallest edit distance to `given`; empty if no names are known.
std::string nearestName(std::string_view given, const std::vector<std::string>& known);

/// The message `unknown <kind> 'given'; did you mean 'nearest'? Known: a, b, c`.
std::string unknownName(std::string_view kind, std::string_view given, const std::vector<std::string>& known);

}  // namespace irk
