// Messages of misuse: nearest known name, lists.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace irk {

/// The known name with the smallest edit distance.
std::string nearestName(std::string_view given, const std::vector<std::string>& known);

/// `unknown <kind> 'given'; did you mean 'nearest'? Known: a, b, c`
std::string unknownName(std::string_view kind, std::string_view given,
                        const std::vector<std::string>& known);

}  // namespace irk
