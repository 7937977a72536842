#include "experiments/commands/out_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "experiments/base/failure.h"
#include "experiments/runs/error_bar.h"
#include "experiments/runs/peers/catalogue.h"
#include "irk/misuse.h"

namespace irk {
namespace {

constexpr Range kPoints = Range::integers(2, 1'000'000);

RowTimes timesOf(const SolveOptions& options, const RunSpec& spec) {
  if (options.bars && options.out.empty()) throw Misuse("--bars belongs to --out, which is not given");
  if (options.bars && options.points.empty()) {
    throw Misuse("--bars needs --points: two integrations have no steps in common");
  }
  if (options.points.empty()) return {};
  if (options.out.empty()) throw Misuse("--points belongs to --out, which is not given");
  if (findPeer(spec.method)) {
    throw Misuse(fmt::format(
        "--points: method '{}' gives the solution at the ends of its steps only; leave --points out", spec.method));
  }
  return {static_cast<int>(parseInteger("points", options.points, kPoints)), false};
}

}  // namespace

OutFile::OutFile(const SolveOptions& options, const RunSpec& spec)
    : spec_(spec),
      path_(options.out),
      bars_(options.bars),
      times_(timesOf(options, spec)),
      rows_(times_, spec.t_end, [this](const SolutionRow& row) { take(row); }) {
  if (asked()) requireSolutionPath(path_);
}

void OutFile::addTo(Watch& watch) {
  if (asked()) rows_.addTo(watch);
}

void OutFile::take(const SolutionRow& row) {
  if (!file_) file_ = solutionFile(path_, spec_);
  file_->append(row);
  if (bars_) kept_.emplace_back(row);
  t_ = row.t;
}

void OutFile::finish(const RunRecord& record, const Watch& watch, std::ostream& err) {
  if (!asked()) return;
  rows_.finish(record);
  if (record.succeeded() && bars_) {
    Watch second{watch.stop, {}, {}, {}};
    std::vector<KeptRow> strict;
    const RunRecord measured = executeWithRows(independentSpec(spec_), second, times_, strict);
    // Written beside the file and put in its place, so that no row is lost if the disk is full.
    const std::filesystem::path file = path_;
    const auto beside = file.parent_path() / (file.stem().string() + ".with_bars" + file.extension().string());
    const auto with_bars = solutionFile(beside, spec_, RowBars::kWritten);
    for (const KeptRow& row : barred(kept_, strict)) with_bars->append(row.view());
    std::filesystem::rename(beside, file);
    if (!measured.succeeded()) {
      printErrorLine(err, fmt::format("{}: bars are unknown beyond t = {:.15g}: the second integration ended as {}",
                                      path_, measured.t, measured.outcome));
    }
  }
  if (record.succeeded() || !file_) return;
  printErrorLine(err, fmt::format("{} holds the solution up to t = {:.15g}: {}", path_, t_, record.outcome));
}

}  // namespace irk
