#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <map>

#include "experiments/audit/audit.h"
#include "experiments/claims/claims.h"
#include "experiments/commands/commands.h"
#include "experiments/environment.h"
#include "experiments/interrupt.h"
#include "experiments/report.h"
#include "experiments/results.h"
#include "experiments/run_table.h"
#include "experiments/store/failure.h"
#include "experiments/timing.h"

namespace irk {
namespace {

// In the order in which a reader wants them: what is computed, whether it is right, what it costs.
constexpr std::string_view kPaperStudies[] = {"scenes",
                                              "audit",
                                              "order",
                                              "cpu_time",
                                              "families",
                                              "steps",
                                              "discontinuity",
                                              "peers",
                                              "work_precision",
                                              "beam",
                                              "jacobian",
                                              "newton_rule",
                                              "k_form",
                                              "phases",
                                              "scaling",
                                              "control",
                                              "estimate",
                                              "drift",
                                              "round_off",
                                              "small_steps",
                                              "failure_constraints",
                                              "failure_stability",
                                              "failure_newton"};

void printSummary(const Study& study, const Table& runs, const std::filesystem::path& folder,
                  std::ostream& out) {
  std::map<std::string, int> outcomes;
  for (const auto& row : runs.rows) ++outcomes[textAt(runs, row, "outcome")];
  fmt::print(out, "{}: {} runs in {}", study.id, runs.rows.size(), folder.string());
  for (const auto& [outcome, count] : outcomes) fmt::print(out, ", {} {}", count, outcome);
  out << '\n';
}

int runStored(const Study& study, const RunnerOptions& options, Streams streams) {
  const auto folder = studyFolder(study, options);
  store::Store store(folder, study.id, store::Use::kWrite, options.store, streams.err);
  Table runs = runStudy(study, options, store, streams.err);
  const bool whole = options.shards == 1;
  if (!interruptFlag() && whole && study.timing.wanted && refusedTimes(runs.head).empty()) {
    timeStudy(study, store, runs, streams.err);
    runs = readTable(folder / "runs.csv");
  }
  std::vector<std::string> doubts;
  if (whole) doubts = writeSummaries(study, runs, folder, streams.err);
  printSummary(study, runs, folder, streams.out);
  if (whole && study.audit) {
    streams.out << audit::auditRuns(study, runs, folder, threadCount(options.jobs), streams.err);
  }
  for (const auto& line : doubts) fmt::print(streams.err, "{}: {}\n", study.id, line);
  if (!interruptFlag()) return doubts.empty() ? 0 : 1;
  streams.err << "interrupted; finished runs are kept, the same command continues\n";
  return kInterruptedStatus;
}

int runOne(const Study& study, const RunnerOptions& options, Streams streams) {
  try {
    return runStored(study, options, streams);
  } catch (const store::StoreFailure& failure) {
    fmt::print(streams.err, "irk: {}\n", failure.what());
    return interruptFlag() ? kInterruptedStatus : 1;
  }
}

}  // namespace

int runCommand(const RunOptions& options, Streams streams) {
  const Study study = loadStudy(options.study, options.variant);
  const InterruptScope interrupts;
  return runOne(study, options.runner, streams);
}

int paperCommand(const RunOptions& options, Streams streams) {
  const InterruptScope interrupts;
  tableauTable(options.runner.results.string(), streams);
  int worst = 0;  // a study that fails does not keep the others from being run
  for (const auto id : kPaperStudies) {
    const int status = runOne(loadStudy(id, options.variant), options.runner, streams);
    if (status == kInterruptedStatus) return status;
    worst = std::max(worst, status);
  }
  return std::max(worst, reportCommand(options.runner.results.string(), streams));
}

int plotCommand(const std::string& study, const std::string& results, Streams streams) {
  const ReportOptions options{results, homeFolder()};
  return drawFigures(study, options, streams.err) == 0 ? 0 : 1;
}

int claimsCommand(const std::string& results, Streams streams) {
  streams.out << claims::claimsText(claims::ResultTables(results));
  return 0;
}

int reportCommand(const std::string& results, Streams streams) {
  const ReportOptions options{results, homeFolder()};
  const int failures = drawFigures("", options, streams.err);
  streams.out << "report: " << writeReport(options).string() << '\n';
  return failures == 0 ? 0 : 1;
}

}  // namespace irk
