#include "experiments/analyses/results.h"

#include <fstream>
#include <ostream>
#include <string>
#include <utility>

#include "experiments/store/store.h"
#include "experiments/study/analysis.h"

namespace irk {

std::string refusedTimes(const TableHead& head) {
  for (const auto& [key, value] : head) {
    if (key == store::kTimesRefused) return value;
  }
  return {};
}

std::string refusedTimes(const std::filesystem::path& runs) {
  const auto start = "# " + std::string(store::kTimesRefused) + ": ";
  std::ifstream in(runs);
  for (std::string line; std::getline(in, line) && line.starts_with('#');) {
    if (line.starts_with(start)) return line.substr(start.size());
  }
  return {};
}

std::vector<std::string> writeSummaries(const Study& study, const Table& runs, const std::filesystem::path& folder,
                                        std::ostream& progress) {
  std::vector<std::string> doubts;
  const std::string refusal = refusedTimes(runs.head);
  if (!refusal.empty()) doubts.push_back(refusal);
  for (const Analysis* analysis : study.analyses) {
    for (auto& line : analysis->run({study, runs, folder, progress})) doubts.push_back(std::move(line));
  }
  return doubts;
}

}  // namespace irk
