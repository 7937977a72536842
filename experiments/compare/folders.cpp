#include "experiments/compare/folders.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/tables/table.h"
#include "experiments/tables/timing_class.h"
#include "irk/misuse.h"

namespace irk::compare {
namespace {

constexpr const char* kFile = "runs.csv";

struct KindName {
  Kind kind;
  const char* name;
};
constexpr KindName kKinds[] = {{Kind::kMissing, "runs that only one has"},
                               {Kind::kOutcome, "outcomes"},
                               {Kind::kCounter, "counters"},
                               {Kind::kError, "errors"},
                               {Kind::kTime, "times"}};

std::string kindText(const KindName& kind, const Comparison& comparison) {
  const auto count = comparison.counts[static_cast<std::size_t>(kind.kind)];
  if (count == 0) return {};
  const auto shown = count > kWorst ? fmt::format(", the worst {}", kWorst) : std::string();
  std::string text = fmt::format("  {}: {} different{}\n", kind.name, count, shown);
  for (const auto& difference : comparison.differences) {
    if (difference.kind == kind.kind) text += fmt::format("    {}: {}\n", difference.run, difference.what);
  }
  return text;
}

std::string timesText(const Times& times) {
  std::string text;
  if (times.other_processor > 0) {
    text += fmt::format("  times of {} runs are not comparable: they were measured on {}\n", times.other_processor,
                        times.processors);
  }
  if (times.few > 0) {
    text += fmt::format(
        "  times of {} runs have fewer than five stored repetitions: only their minima are compared, "
        "nothing is tested\n",
        times.few);
  }
  if (times.compared > 0) {
    text += fmt::format("  time of the second / first: {:.3g}, the middle of {} runs, from {:.3g} to {:.3g}\n",
                        times.median, times.compared, times.least, times.most);
  }
  if (times.not_timed > 0) text += fmt::format("  not timed in both: {} runs\n", times.not_timed);
  return text;
}

}  // namespace

std::map<std::string, std::filesystem::path> runsIn(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  if (!fs::is_directory(folder)) {
    throw Misuse(fmt::format("{}: a folder of a study or of results is expected", folder.string()));
  }
  if (fs::is_regular_file(folder / kFile)) return {{"", folder / kFile}};
  std::map<std::string, fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().filename() != kFile || !entry.is_regular_file()) continue;
    found[fs::relative(entry.path().parent_path(), folder).string()] = entry.path();
  }
  if (found.empty()) throw Misuse(fmt::format("{}: no {} in it or below it", folder.string(), kFile));
  return found;
}

Runs runsOf(const std::filesystem::path& file) {
  Runs runs{file, {}};
  const auto environments = file.parent_path() / "environments.csv";
  if (!std::filesystem::is_regular_file(environments)) return runs;
  const Table table = readTable(environments);
  const auto id = table.column("environment");
  for (const auto& row : table.rows) {
    for (const std::string library : {"", "SUNDIALS", "GSL"}) {
      runs.processors[row[id] + library] = timingClass(table.columns, row, library);
    }
  }
  return runs;
}

std::string textOf(const std::string& study, const Comparison& comparison) {
  auto text = fmt::format("{}{}{} runs and {} runs: {} differences\n", study, study.empty() ? "" : ": ",
                          comparison.first, comparison.second, comparison.total());
  for (const auto& kind : kKinds) text += kindText(kind, comparison);
  text += timesText(comparison.times);
  if (!comparison.not_compared.empty()) {
    text += fmt::format("  not compared: {}\n", fmt::join(comparison.not_compared, ", "));
  }
  return text;
}

}  // namespace irk::compare
