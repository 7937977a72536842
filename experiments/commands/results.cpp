#include "experiments/analyses/results.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <charconv>
#include <iterator>
#include <memory>
#include <set>
#include <sstream>

#include "experiments/audit/audit.h"
#include "experiments/base/child_process.h"
#include "experiments/base/failure.h"
#include "experiments/base/interrupt.h"
#include "experiments/commands/commands.h"
#include "experiments/report/own_figures.h"
#include "experiments/report/publish/publish.h"
#include "experiments/report/publish/published_runs.h"
#include "experiments/report/report.h"
#include "experiments/runner/merge.h"
#include "experiments/runner/shards.h"
#include "experiments/runner/status.h"
#include "experiments/runner/study_file.h"
#include "experiments/study/study_reader.h"
#include "experiments/tables/environment.h"
#include "irk/misuse.h"

namespace irk {
namespace {

using Stores = std::vector<std::unique_ptr<store::Store>>;

Stores openAll(const MergeOptions& options, std::ostream& err) {
  Stores stores;
  for (const auto& folder : options.folders) {
    if (!std::filesystem::is_directory(folder))
      throw Misuse(fmt::format("{}: a folder of a study is expected", folder));
    stores.push_back(std::make_unique<store::Store>(folder, "", store::Use::kRead, store::StoreOptions(), err));
  }
  return stores;
}

// The one study that all rows name. Throws Misuse if they name none (with the first note about unreadable files) or
// two.
std::string studyOf(const Stores& stores, const std::string& notes) {
  const auto studies = store::studiesIn(stores);
  if (studies.empty()) {
    throw Misuse("no run of this version in any of the folders, neither in parts/ nor in runs.csv" +
                 (notes.empty() ? "" : ": " + notes.substr(0, notes.find('\n'))));
  }
  if (studies.size() > 1) {
    const auto& [first, in_first] = *studies.begin();
    const auto& [second, in_second] = *std::next(studies.begin());
    throw Misuse(fmt::format("two studies at once: '{}' in {}, '{}' in {}", first, in_first, second, in_second));
  }
  return studies.begin()->first;
}

// The number n in a folder name `shard_<i>_of_<n>`; 0 for other names.
std::size_t shardCountOf(std::filesystem::path folder) {
  if (!folder.has_filename()) folder = folder.parent_path();
  const auto name = folder.filename().string();
  const auto of = name.rfind("_of_");
  std::size_t shards = 0;
  if (!name.starts_with("shard_") || of == name.npos) return 0;
  std::from_chars(name.data() + of + 4, name.data() + name.size(), shards);
  return shards;
}

// The commands that make the missing runs.
std::string commandsOf(const MergeOptions& options, const Study& made, const store::MergeReport& report) {
  const std::string& study = options.study;
  std::string results = options.results;
  std::set<std::size_t> counts;
  for (const auto& folder : options.folders) counts.insert(shardCountOf(folder));
  const std::size_t shards = counts.size() == 1 ? *counts.begin() : 0;
  std::filesystem::path first = options.folders.front();
  if (!first.has_filename()) first = first.parent_path();
  if (shards > 0) results = first.parent_path().parent_path().string();
  const bool quick = options.variant == StudyVariant::kQuick;
  if (quick) results = std::filesystem::path(results).parent_path().string();  // --quick adds its own folder
  const auto command = [&](const std::string& shard) {
    std::vector<std::string> words{"run", study};
    if (quick) words.emplace_back("--quick");
    if (!shard.empty()) words.insert(words.end(), {"--shard", shard});
    if (!results.empty()) words.insert(words.end(), {"--results", results});
    return "  " + programCommand(words) + '\n';
  };
  if (shards == 0) return command("");
  const auto shard_of = shardsOf(made, static_cast<int>(shards));
  std::set<int> missing;
  for (const auto series : report.missing_series) missing.insert(shard_of[series]);
  std::string text;
  for (const auto shard : missing) text += command(fmt::format("{}/{}", shard, shards));
  return text;
}

// The first study with runs that are still to be made or timed.
void requireFinished(const std::vector<std::string>& studies, const PublishOptions& options, std::ostream& err) {
  RunnerOptions runner;
  runner.results = options.results;
  for (const auto& id : studies) {
    const Study study = loadStudy(id, options.variant);
    const store::Store store(studyFolder(study, runner), id, store::Use::kRead, runner.store, err);
    const StudyStatus status = statusOf(study, runner, store);
    const std::size_t missing = status.all.planned - status.all.finished;
    if (missing == 0 && status.to_time == 0) continue;
    throw Failure(fmt::format(
        "'{}' cannot be published: of the study {} {} runs are missing and {} lack times; irk run "
        "{}{} goes on with it",
        options.results, id, missing, status.to_time, id, options.variant == StudyVariant::kQuick ? " --quick" : ""));
  }
}

}  // namespace

int mergeCommand(MergeOptions options, Streams streams) {
  std::ostringstream notes;
  const Stores stores = openAll(options, notes);
  const auto named = studyOf(stores, notes.str());
  streams.err << notes.str();
  if (options.study.empty()) options.study = named;
  const Study study = loadStudy(options.study, options.variant);
  const FigureTables figures = figuresOfStudy(study, options.study);
  if (study.id != named) {
    throw Misuse(fmt::format("the folders hold the study '{}', not '{}'", named, study.id));
  }
  const auto folder = std::filesystem::path(options.results) / study.id;
  for (const auto& from : options.folders) {
    std::error_code none;
    if (!std::filesystem::equivalent(from, folder, none)) continue;
    throw Misuse(fmt::format("{}: the rows are merged there, and those that are there count: leave it out", from));
  }
  if (isStudyFile(options.study)) keepStudyFile(options.study, folder);
  store::Store merged(folder, study.id, store::Use::kWrite, options.store, streams.err);
  std::vector<const store::Store*> all{&merged};
  for (const auto& store : stores) all.push_back(store.get());
  const RunKeys keys = runKeys(study, {});
  const auto report = store::reportOf(study, keys, all);
  fmt::print(streams.out, "{}: {}", study.id, store::textOf(report));
  if (report.missing > 0) streams.out << "still to be run:\n" << commandsOf(options, study, report);
  const bool refused = !options.partial && (report.missing > 0 || !report.conflicts.empty());
  if (refused) {
    streams.err << "nothing is merged; --partial merges what there is\n";
    return 1;
  }
  for (const auto& store : stores) merged.takeOver(*store);
  merged.exportTables(keys);
  keepFigures(figures, folder);
  const RunFile runs(folder / "runs.csv");
  writeSummaries(study, runs, folder, streams.err);
  fmt::print(streams.out, "{}: {} runs of {} folders in {}\n", study.id, runs.rows(), options.folders.size(),
             folder.string());
  if (study.audit) {
    const InterruptScope interrupts;
    streams.out << audit::auditRuns(study, folder, threadCount(0), streams.err);
    if (interruptFlag()) return kInterruptedStatus;
  }
  const std::string refusal = refusedTimes(runs.names().head);
  if (!refusal.empty()) streams.err << refusal << '\n';
  tellDrift(study.id, folder / "runs.csv", streams.err);
  return refusal.empty() ? 0 : 1;
}

int statusCommand(const RunOptions& options, Streams streams) {
  const Study study = loadStudy(options.study, options.variant, options.peers);
  (void)figuresOfStudy(study, options.study);  // its mistakes are found before the runs are made
  const auto folder = studyFolder(study, options.runner);
  const store::Store store(folder, study.id, store::Use::kRead, options.runner.store, streams.err);
  fmt::print(streams.out, "{} in {}\n{}", study.id, folder.string(), textOf(statusOf(study, options.runner, store)));
  if (store.runs().damaged() > 0) {
    fmt::print(streams.out, "  {} rows cannot be read: irk run sets them aside\n", store.runs().damaged());
  }
  const std::string writer = store::writerIn(folder);
  if (!writer.empty()) fmt::print(streams.out, "  {}\n", writer);
  return 0;
}

int publishCommand(const PublishOptions& options, Streams streams) {
  const ReportOptions report{options.results, homeFolder()};
  requireResultsFolder(report.results);
  if (areQuick(report) && options.variant == StudyVariant::kFull) {
    throw Misuse(
        fmt::format("--results '{}': these are results of quick runs; irk publish --quick publishes them, "
                    "marked as such",
                    options.results));
  }
  auto studies = paperStudies();
  studies.emplace_back("audit");
  (void)report::publishedRuns(report, studies);
  requireFinished(studies, options, streams.err);
  const int doubts = report::publish(report, studies, options.into, streams.err);
  fmt::print(streams.out, "published: {}\n", (std::filesystem::path(options.into) / "README.md").string());
  return doubts == 0 ? 0 : kFailedStatus;
}

}  // namespace irk
