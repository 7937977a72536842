// The names of a study's blocks, by which figures and claims choose runs.
#pragma once

#include <string>
#include <string_view>

namespace irk {

/// The last column of runs.csv and of tables made from it: the blocks that a run or a series is in, separated by blanks.
/// It is written when tables are exported and is no part of a run's key: a block can get another name.
inline constexpr std::string_view kBlockColumn = "block";

/// Whether `name` is one of the names.
bool hasBlock(std::string_view names, std::string_view name);
/// Adds those of `more` that are not there yet.
void addBlocks(std::string& names, std::string_view more);

}  // namespace irk
