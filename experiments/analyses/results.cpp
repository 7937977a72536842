#include "experiments/analyses/results.h"

#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <fstream>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>

#include "experiments/store/calibration.h"
#include "experiments/store/store.h"
#include "experiments/study/analysis.h"

namespace irk {

namespace {

std::string fileEntry(const std::filesystem::path& file, std::string_view key) {
  const auto start = "# " + std::string(key) + ": ";
  std::ifstream in(file);
  for (std::string line; std::getline(in, line) && line.starts_with('#');) {
    if (line.starts_with(start)) return line.substr(start.size());
  }
  return {};
}

}  // namespace

std::string refusedTimes(const TableHead& head) { return headEntry(head, store::kTimesRefused); }

std::string refusedTimes(const std::filesystem::path& runs) { return fileEntry(runs, store::kTimesRefused); }

std::string timesDrift(const std::filesystem::path& runs) { return fileEntry(runs, store::kTimesDrift); }

std::string timingCores(const std::filesystem::path& runs) { return fileEntry(runs, store::kTimingCores); }

void tellDrift(const std::string& study, const std::filesystem::path& runs, std::ostream& out) {
  const auto drift = timesDrift(runs);
  if (drift.empty()) return;
  out << study << (study.empty() ? "" : ": ") << "the times are doubtful: " << drift
      << "; calibrations.csv has all of them, --fresh measures again\n";
}

void tellDrifts(const std::vector<std::filesystem::path>& folders, std::ostream& out) {
  std::vector<std::string> doubtful;
  for (const auto& folder : folders) {
    if (!timesDrift(folder / "runs.csv").empty()) doubtful.push_back(folder.filename());
  }
  if (doubtful.empty()) return;
  fmt::print(out, "the times of {} studies are doubtful, the machine was busy: {}\n", doubtful.size(),
             fmt::join(doubtful, ", "));
}

void writeSummaries(const Study& study, const RunFile& runs, const std::filesystem::path& folder,
                    std::ostream& progress) {
  for (const Analysis* analysis : study.analyses) analysis->run({study, runs, folder, progress});
}

}  // namespace irk
