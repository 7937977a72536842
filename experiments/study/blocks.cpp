#include "experiments/study/blocks.h"

#include "experiments/runs/block_names.h"

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

}  // namespace irk
