#include "experiments/claims/block_file.h"

#include <algorithm>
#include <utility>

#include "experiments/runs/block_names.h"

namespace irk::claims {

BlockFile::BlockFile(const std::filesystem::path& file) : file_(file) {
  const auto column = names().column(kBlockColumn);
  for (auto begin = file_.position();; begin = file_.position()) {
    const auto row = file_.next();
    if (!row) break;
    const auto& cell = (*row)[column];
    if (pieces_.empty() || blocks_[pieces_.back().blocks] != cell) {
      const auto at = std::find(blocks_.begin(), blocks_.end(), cell);
      pieces_.push_back({begin, static_cast<std::uint32_t>(at - blocks_.begin()), 0});
      if (at == blocks_.end()) blocks_.push_back(cell);
    }
    ++pieces_.back().rows;
  }
}

void BlockFile::forEachRow(const std::function<bool(const std::string& blocks)>& wanted,
                           const std::function<void(TableRow row)>& take) {
  std::vector<bool> is_wanted;
  for (const auto& blocks : blocks_) is_wanted.push_back(wanted(blocks));
  for (const auto& piece : pieces_) {
    if (!is_wanted[piece.blocks]) continue;
    file_.seek(piece.begin);
    for (std::uint32_t i = 0; i < piece.rows; ++i) take(file_.next().value());
  }
}

}  // namespace irk::claims
