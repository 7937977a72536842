#include "experiments/results.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>

#include "experiments/audit/audit.h"
#include "experiments/commands/commands.h"
#include "experiments/final_states.h"
#include "experiments/interrupt.h"

namespace irk {
namespace {

std::string studyNamed(const Table& runs, const MergeOptions& options) {
  if (!options.study.empty()) return options.study;
  const auto named = std::find_if(runs.head.begin(), runs.head.end(),
                                  [](const auto& entry) { return entry.first == "study"; });
  if (named == runs.head.end()) throw Misuse("the tables name no study: give --study ID|FILE");
  return named->second;
}

}  // namespace

int mergeCommand(const MergeOptions& options, Streams streams) {
  const Table merged = mergedRuns(options.folders);
  const Study study = loadStudy(studyNamed(merged, options), StudyVariant::kFull);
  const Table runs = sortedRuns(merged, study);
  const auto folder = std::filesystem::path(options.results) / study.id;
  writeTable(folder / "runs.csv", runs);
  const auto doubts = writeSummaries(study, runs, folder, streams.err);
  fmt::print(streams.out, "{}: {} runs of {} folders in {}\n", study.id, runs.rows.size(),
             options.folders.size(), folder.string());
  if (study.states) writeTable(folder / "states.csv", mergedStates(options.folders));
  if (study.audit) {
    const InterruptScope interrupts;
    streams.out << audit::auditRuns(study, runs, folder, threadCount(0), streams.err);
    if (interruptFlag()) return kInterruptedStatus;
  }
  for (const auto& line : doubts) streams.err << line << '\n';
  return doubts.empty() ? 0 : 1;
}

}  // namespace irk
