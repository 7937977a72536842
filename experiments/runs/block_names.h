// The names of a study's blocks, by which figures and claims choose runs.
#pragma once

#include <string>
#include <string_view>

namespace irk {

/// The last column of runs.csv and of tables made from it: the blocks that contain the run or series, separated by
/// blanks. It is written on export and is not part of a run's key, so blocks can be renamed.
inline constexpr std::string_view kBlockColumn = "block";

/// Whether the list `names` contains `name`.
inline bool hasBlock(std::string_view names, std::string_view name) {
  while (!names.empty()) {
    const auto end = names.find(' ');
    if (names.substr(0, end) == name) return true;
    names.remove_prefix(end == names.npos ? names.size() : end + 1);
  }
  return false;
}

/// Adds the names in `more` that `names` does not contain yet.
inline void addBlocks(std::string& names, std::string_view more) {
  while (!more.empty()) {
    const auto end = more.find(' ');
    const auto name = more.substr(0, end);
    if (!hasBlock(names, name)) names += (names.empty() ? "" : " ") + std::string(name);
    more.remove_prefix(end == more.npos ? more.size() : end + 1);
  }
}

}  // namespace irk
