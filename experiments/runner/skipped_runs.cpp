#include "experiments/runner/skipped_runs.h"

#include <optional>

#include "experiments/base/numbers.h"
#include "experiments/runs/final_states.h"
#include "experiments/runs/run_table.h"
#include "experiments/store/facts.h"
#include "experiments/study/series_rules.h"
#include "experiments/study/series_walk.h"

namespace irk {
namespace {

class Skipped {
 public:
  Skipped(const Study& study, store::Store& store) : study_(study), store_(store) {}

  void record(const Series& series, const std::vector<std::uint64_t>& keys) {
    SeriesWalk walk(series);
    while (const auto run = walk.next()) {
      if (walk.tooLong()) {
        recordOne(series.runs[*run], keys[*run], keys[*walk.tooLong()]);
      } else {
        const auto entry = store_.runs().find(keys[*run]);
        if (!entry) return;  // after an interrupt
        walk.record(*run, store::factsOf(store_.runs(), *entry, false));
      }
    }
  }

 private:
  void recordOne(const RunSpec& spec, std::uint64_t key, std::uint64_t easier) {
    const store::Rows& rows = store_.runs();
    const RunRecord record = notMade(spec, rows.row(*rows.find(easier)), columns_);
    const auto entry = rows.find(key);
    if (entry && textAt(columns_, rows.row(*entry), "detail") == record.detail) return;
    const std::string text = hexText(key);
    if (study_.states) store_.addState(text, vectorText(componentsOf(record)), vectorText(barsOf(record)));
    store_.addRun(runRow(text, study_.id, record));
  }

  const Study& study_;
  store::Store& store_;
  const Table columns_{{}, runColumns(), {}};
};

}  // namespace

void recordSkippedRuns(const Study& study, const store::RunKeys& keys, store::Store& store) {
  Skipped skipped(study, store);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys.isLeftOut(i)) continue;
    const Series series = study.series[i];
    if (series.end == SeriesEnd::kTooLong) skipped.record(series, keys[i]);
  }
}

}  // namespace irk
