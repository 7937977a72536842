#include "experiments/study/blocks.h"

namespace irk {

BlockNames blocksOf(const Study& study, const std::vector<std::vector<std::uint64_t>>& keys) {
  BlockNames names;
  for (std::size_t i = 0; i < study.series.size(); ++i) {
    const std::string& block = study.series[i].block;
    if (block.empty()) continue;
    for (const auto key : keys[i]) addBlocks(names[key], block);
  }
  return names;
}

bool hasBlock(std::string_view names, std::string_view name) {
  while (!names.empty()) {
    const auto end = names.find(' ');
    if (names.substr(0, end) == name) return true;
    names.remove_prefix(end == names.npos ? names.size() : end + 1);
  }
  return false;
}

void addBlocks(std::string& names, std::string_view more) {
  while (!more.empty()) {
    const auto end = more.find(' ');
    const auto name = more.substr(0, end);
    if (!hasBlock(names, name)) names += (names.empty() ? "" : " ") + std::string(name);
    more.remove_prefix(end == more.npos ? more.size() : end + 1);
  }
}

}  // namespace irk
