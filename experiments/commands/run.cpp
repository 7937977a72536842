#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "experiments/analyses/results.h"
#include "experiments/audit/audit.h"
#include "experiments/base/failure.h"
#include "experiments/base/interrupt.h"
#include "experiments/claims/claims_text.h"
#include "experiments/commands/commands.h"
#include "experiments/own/crash.h"
#include "experiments/report/explorer/explorer.h"
#include "experiments/report/own_figures.h"
#include "experiments/report/report.h"
#include "experiments/runner/cores/at_once.h"
#include "experiments/runner/merge.h"
#include "experiments/runner/ranks.h"
#include "experiments/runner/skipped_runs.h"
#include "experiments/runner/study_file.h"
#include "experiments/runner/timing.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/study_reader.h"
#include "experiments/tables/environment.h"
#include "irk/misuse.h"

namespace irk {
namespace {

// Ordered for the reader: first the solutions, then their correctness, then their cost. `audit` is a study of its own:
// it judges the whole program and takes as long as half of the others.
constexpr const char* kPaperStudies =
    "scenes order cpu_time families steps discontinuity flexible_contact peers work_precision robustness beam "
    "heat jacobian newton_rule contraction newton_contact k_form phases scaling parallel control estimate "
    "reliability claims drift conservation round_off formulations small_steps failure_constraints "
    "failure_stability failure_newton";

/// How the runs of a study ended.
struct Outcomes {
  std::size_t runs = 0;
  std::map<std::string, std::size_t> counts;
  std::optional<store::Entry> refused;  // the first run that can never work

  std::size_t refusals() const { return refused ? counts.at("refused") : 0; }
  bool allRefused() const { return refused && refusals() == runs; }
};

Outcomes outcomesOf(const store::Store& store, const RunKeys& keys) {
  Outcomes found;
  store.forEachRun(keys, [&](const store::Entry& entry, const std::string&) {
    const std::string& outcome = store.runs().name(entry.outcome);
    ++found.runs;
    ++found.counts[outcome];
    if (outcome == "refused" && !found.refused) found.refused = entry;
  });
  return found;
}

void printSummary(const Study& study, const store::Store& store, const Outcomes& outcomes, std::ostream& out) {
  fmt::print(out, "{}: {} runs in {}", study.id, outcomes.runs, store.folder().string());
  for (const auto& [outcome, count] : outcomes.counts) fmt::print(out, ", {} {}", count, outcome);
  out << '\n';
}

// How many runs were refused, and the reason for the first one.
std::string refusalLine(const std::string& study, const store::Store& store, const Outcomes& outcomes) {
  const Table columns{{}, runColumns(), {}};
  const std::string count = outcomes.allRefused() ? fmt::format("all {}", outcomes.runs)
                                                  : fmt::format("{} of {}", outcomes.refusals(), outcomes.runs);
  return fmt::format("{}: {} runs were refused, the first one for: {}", study, count,
                     textAt(columns, store.runs().row(*outcomes.refused), "detail"));
}

// Whether tables are made from the runs.
bool hasSummaries(const Study& study) { return !study.analyses.empty() || study.audit; }

// Makes this rank's part of the runs and of the times, and prints nothing; for ranks other than 0, which merges and
// reports.
void joinStudy(const Study& study, const RunnerOptions& options, Ranks& ranks) {
  std::ostream silent(nullptr);
  const auto folder = studyFolder(study, options);
  ranks.meet();  // rank 0 holds the lock
  std::optional<store::Store> store(std::in_place, folder, study.id, store::Use::kJoin, options.store, silent);
  const RunKeys keys = makeRuns(study, options, *store, ranks, silent);
  store.reset();
  ranks.meet();  // all rows are written
  if (!ranks.asTheFirst(false)) return;
  if (const auto share = timingShare(ranks, options)) {
    store.emplace(folder, study.id, store::Use::kJoin, options.store, silent);
    timeStudy(study, keys, *store, *share, silent);
  }
  store.reset();
  ranks.meet();  // all times are written
}

// Measures the times on all hosts, then reads the store again.
void timeTogether(const Study& study, const RunKeys& keys, const RunnerOptions& options, Ranks& ranks,
                  std::optional<store::Store>& store, std::ostream& err) {
  const auto share = timingShare(ranks, options);
  if (share->hosts > 1)
    fmt::print(err, "{}: {} hosts measure times, each its share of the series\n", study.id, share->hosts);
  timeStudy(study, keys, *store, *share, err);
  ranks.meet();
  if (ranks.count() > 1) {
    store.reset();
    store.emplace(studyFolder(study, options), study.id, store::Use::kWrite, options.store, err);
  }
  store->exportTables(keys);
}

// What other ranks have made must be where this one reads.
void requireRowsOfAll(const Study& study, const RunKeys& keys, const store::Store& store) {
  const auto report = store::reportOf(study, keys, {&store});
  if (report.missing == 0 || interruptFlag()) return;
  throw Failure(fmt::format(
      "{}: {} of {} runs are missing after all ranks have ended. Results must be in a folder that all hosts "
      "share: --results {}",
      study.id, report.missing, report.expected, store.folder().string()));
}

// Makes the runs on all ranks, then reads the store again.
RunKeys makeAllRuns(const Study& study, const RunnerOptions& options, Ranks& ranks, std::optional<store::Store>& store,
                    std::ostream& err) {
  const auto open = [&] {
    store.reset();
    store.emplace(studyFolder(study, options), study.id, store::Use::kWrite, options.store, err);
  };
  open();
  ranks.meet();
  if (ranks.count() > 1)
    fmt::print(err, "{}: {} ranks; what another one gets counts as done\n", study.id, ranks.count());
  auto keys = makeRuns(study, options, *store, ranks, err);
  ranks.meet();
  if (ranks.count() > 1) {
    open();  // includes the rows of the other ranks
  }
  recordSkippedRuns(study, keys, *store);
  if (ranks.count() > 1) requireRowsOfAll(study, keys, *store);
  store->exportTables(keys);
  return keys;
}

int runStored(const Study& study, const FigureTables& figures, const RunnerOptions& options, Ranks& ranks,
              Streams streams) {
  const auto folder = studyFolder(study, options);
  std::optional<store::Store> opened;
  const auto keys = makeAllRuns(study, options, ranks, opened, streams.err);
  keepFigures(figures, folder);
  const auto file = folder / "runs.csv";
  const bool whole = options.shard.count == 1;
  const bool times = whole && study.timing.wanted && refusedTimes(file).empty() && !interruptFlag();
  if (ranks.asTheFirst(times)) timeTogether(study, keys, options, ranks, opened, streams.err);
  const store::Store& store = *opened;
  const Outcomes outcomes = outcomesOf(store, keys);
  if (!whole || !hasSummaries(study)) {
    printSummary(study, store, outcomes, streams.out);
  } else {
    writeSummaries(study, RunFile(file), folder, streams.err);
    printSummary(study, store, outcomes, streams.out);
    if (study.audit) {
      streams.out << audit::auditRuns(study, folder, threadCount(options.jobs), streams.err);
    }
  }
  const std::string refusal = refusedTimes(file);
  if (!refusal.empty()) fmt::print(streams.err, "{}: {}\n", study.id, refusal);
  tellDrift(study.id, file, streams.err);
  if (outcomes.allRefused()) {
    printErrorLine(streams.err, refusalLine(study.id, store, outcomes));
  } else if (outcomes.refused) {
    fmt::print(streams.err, "{}\n", refusalLine(study.id, store, outcomes));
  }
  if (!interruptFlag()) return refusal.empty() && !outcomes.allRefused() ? 0 : 1;
  streams.err << "interrupted; finished runs are kept, the same command continues\n";
  return kInterruptedStatus;
}

int runOne(const Study& study, const FigureTables& figures, const RunnerOptions& options, Ranks& ranks,
           Streams streams) {
  try {
    return runStored(study, figures, options, ranks, streams);
  } catch (const Failure& failure) {
    printErrorLine(streams.err, failure.what());
    return interruptFlag() ? kInterruptedStatus : kFailedStatus;
  }
}

}  // namespace

int runCommand(const RunOptions& options, Streams streams) {
  const Study study = loadStudy(options.study, options.variant, options.peers);
  const FigureTables figures = figuresOfStudy(study, options.study);
  const auto ranks = joinRanks();
  const auto checkThenKeepFile = [&] {
    if (timingShare(*ranks, options.runner)) cores::requireCores(options.runner.timing_cores);
    if (isStudyFile(options.study)) keepStudyFile(options.study, studyFolder(study, options.runner));
  };
  if (ranks->count() == 1) {
    checkThenKeepFile();
    const InterruptScope interrupts;
    return runOne(study, figures, options.runner, *ranks, streams);
  }
  RunnerOptions each = options.runner;
  if (each.shard.count > 1) throw Misuse("--shard with ranks of mpirun: they share the whole study");
  if (each.jobs == 0) each.jobs = 1;
  const InterruptScope interrupts;
  const auto abandon = [&ranks](int with) {
    own::allowExit();
    ranks->abandon(with);
  };
  int status = 0;
  try {
    checkThenKeepFile();
    if (ranks->rank() == 0) {
      status = runStored(study, figures, each, *ranks, streams);
    } else {
      joinStudy(study, each, *ranks);
    }
  } catch (...) {
    abandon(reportException(streams.err));
  }
  if (interruptFlag()) {
    streams.out.flush();
    abandon(kInterruptedStatus);
  }
  return status;
}

std::vector<std::string> paperStudies() {
  std::istringstream words(kPaperStudies);
  return {std::istream_iterator<std::string>(words), {}};
}

int paperCommand(const RunOptions& options, Streams streams) {
  const auto alone = joinRanks();
  if (alone->count() > 1) throw Misuse("paper under mpirun: its ranks share the runs of one study, irk run STUDY");
  cores::requireCores(options.runner.timing_cores);
  const InterruptScope interrupts;
  tableauTable(options.runner.results.string(), streams);
  int worst = 0;  // continue with the other studies if one fails
  std::vector<std::filesystem::path> folders;
  const auto ids = paperStudies();
  for (const auto& id : ids) {
    fmt::print(streams.err, "paper: study {} of {}, {}\n", folders.size() + 1, ids.size(), id);
    const Study study = loadStudy(id, options.variant);
    folders.push_back(studyFolder(study, options.runner));
    const int status = runOne(study, {}, options.runner, *alone, streams);
    if (status == kInterruptedStatus) return status;
    worst = std::max(worst, status);
  }
  worst = std::max(worst, reportCommand(options.runner.results.string(), streams));
  tellDrifts(folders, streams.err);
  return worst;
}

bool isStudyFile(const std::string& id_or_file) {
  const std::filesystem::path path(id_or_file);
  return path.extension() == ".toml" || path.has_parent_path();
}

int plotCommand(const std::string& id_or_file, StudyVariant variant, const std::string& results, Streams streams) {
  const ReportOptions options{results, homeFolder()};
  std::string id = id_or_file;
  if (isStudyFile(id_or_file)) {  // its figures may have changed since the study was run
    const Study study = loadStudy(id_or_file, variant);
    id = study.id;
    const auto folder = options.results / id;
    const auto figures = figuresOfStudy(study, id_or_file);
    if (!std::filesystem::is_directory(folder)) {
      throw Failure(fmt::format("no results of study '{}' in '{}': irk run {} makes them", id, results, id_or_file));
    }
    keepFigures(figures, folder);
  }
  const int failures = drawFigures(id, options, streams.err);
  fmt::print(streams.out, "figures: {}\n", figureFolder(options).string());
  return failures == 0 ? 0 : kFailedStatus;
}

int claimsCommand(const std::string& results, bool sensitivity, Streams streams) {
  requireResultsFolder(results);
  const auto detail = sensitivity ? claims::Detail::kSensitivity : claims::Detail::kTable;
  streams.out << claims::claimsText(claims::ResultTables(results), detail);
  return 0;
}

int reportCommand(const std::string& results, Streams streams) {
  const ReportOptions options{results, homeFolder()};
  const int failures = drawFigures("", options, streams.err);
  const auto explorer = writeExplorer(options, streams.err);  // first: the page links to it
  streams.out << "report: " << writeReport(options).string() << '\n';
  if (explorer) streams.out << "explorer: " << explorer->string() << '\n';
  return failures == 0 ? 0 : 1;
}

}  // namespace irk
