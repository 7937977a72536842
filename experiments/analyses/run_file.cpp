#include "experiments/analyses/run_file.h"

#include "experiments/runs/block_names.h"

namespace irk {

RunFile::RunFile(const std::filesystem::path& file) : GroupedFile(file, seriesColumns(TableFile(file).names())) {}

HeldSeries RunFile::operator[](std::size_t i) const {
  HeldSeries held;
  held.rows = group(i);
  auto& series = held.series;
  series.name = nameOf(held.rows.front());
  const bool has_blocks = names().hasColumn(kBlockColumn);
  for (const auto& row : held.rows) {
    series.rows.push_back(&row);
    if (has_blocks) addBlocks(series.blocks, textAt(names(), row, kBlockColumn));
  }
  return held;
}

void RunFile::forEachSeries(const std::function<void(const RunSeries&)>& take) const {
  for (std::size_t i = 0; i < size(); ++i) take((*this)[i].series);
}

}  // namespace irk
