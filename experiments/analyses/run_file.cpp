#include "experiments/analyses/run_file.h"

#include "experiments/base/clock.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/progress.h"
#include "experiments/runs/block_names.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/study/study.h"

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

void repeatRuns(const Study& study, const RunFile& runs, Progress* progress, const RepeatRun& repeat) {
  const Table& names = runs.names();
  const SpecsByKey specs(study);
  const auto kind = [&](const TableRow& row) { return textAt(names, row, "settings"); };
  if (progress) runs.forEachRow([&](const TableRow& row) { progress->expect(kind(row)); });
  runs.forEachSeries([&](const RunSeries& series) {
    for (const TableRow* row : series.rows) {
      const auto spec = specs.find(row->front());
      const bool repeated = spec && succeededAt(names, *row) && !findPeer(spec->method) && !interruptFlag();
      const double start = wallSeconds();
      if (repeated) repeat(series, *row, *spec);
      if (!progress) continue;
      if (repeated && !interruptFlag()) {
        progress->finished(kind(*row), wallSeconds() - start);
      } else {
        progress->skipped(kind(*row));
      }
    }
  });
}

}  // namespace irk
