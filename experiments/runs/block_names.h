// The names of a study's blocks, by which figures and claims choose runs.
#pragma once

#include <string>
#include <string_view>

namespace irk {

/// The last column of runs.csv and of tables made from it: the blocks that contain the run or series, separated by
/// blanks. It is written on export and is not part of a run's key, so blocks can be renamed.
inline constexpr std::string_view kBlockColumn = "block";

/// Whether the list `names` contains `name`.
bool hasBlock(std::string_view names, std::string_view name);
/// Adds the names in `more` that `names` does not contain yet.
void addBlocks(std::string& names, std::string_view more);

}  // namespace irk
