#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "experiments/base/interrupt.h"
#include "experiments/commands/commands.h"
#include "experiments/reference/tables.h"
#include "experiments/runner/runner.h"
#include "experiments/runs/fields.h"
#include "experiments/tables/build_info.h"
#include "experiments/tables/environment.h"

namespace irk {
namespace {

std::filesystem::path referenceFolder() { return homeFolder() / "problems" / "reference"; }

// Values computed by other programs or published in tables of other authors.
std::vector<ReferenceValue> independentValues() {
  std::vector<ReferenceValue> all;
  for (const auto* name : {"independent.csv", "test_set.csv"}) {
    const auto file = referenceFolder() / name;
    for (auto& value : referenceValues(file.string(), readTable(file))) all.push_back(std::move(value));
  }
  return all;
}

std::vector<std::string> scenesWanted(const std::vector<std::string>& given) {
  std::vector<std::string> scenes;
  for (const auto& scene : given) scenes.push_back(sceneNamed(scene));
  if (given.empty()) {
    for (const auto& scene : sceneCatalogue()) scenes.push_back(scene.id);
  }
  return scenes;
}

// The times of the task, those of independent values, and the scene's end.
std::vector<std::string> timesOf(const ReferenceTask& task, const std::vector<ReferenceValue>& independent) {
  const RunSpec spec = referenceSpec(task, "", Fineness::kFine);
  std::istringstream words{task.of.times};
  std::vector<std::string> times{std::istream_iterator<std::string>(words), {}};
  times.push_back(fmt::format("{}", spec.t_end));
  const auto settings = settingsText(spec.settings);
  for (const auto& value : independent) {
    if (value.scene == spec.scene && value.settings == settings) times.push_back(value.t);
  }
  std::stable_sort(times.begin(), times.end(), [](const auto& a, const auto& b) { return BigFloat(a) < BigFloat(b); });
  const auto same = [](const auto& a, const auto& b) { return BigFloat(a) == BigFloat(b); };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
  return times;
}

/// The tasks of one scene and their results.
struct SceneReferences {
  std::string scene;
  std::vector<ReferenceValue> values;
  std::vector<std::string> problems;
  std::vector<ReferenceValue> independent;  // those of this scene
  std::vector<std::string> disagreements;   // of independent values
};

SceneReferences referencesOf(const std::string& scene, const std::vector<ReferenceValue>& independent,
                             const ReferenceWatch& watch) {
  SceneReferences result{scene, {}, {}, {}, {}};
  for (const auto& task : referenceTasks()) {
    if (task.scene != scene) continue;
    const auto computed = compute(task, timesOf(task, independent), watch);
    result.values.insert(result.values.end(), computed.values.begin(), computed.values.end());
    result.problems.insert(result.problems.end(), computed.problems.begin(), computed.problems.end());
  }
  std::copy_if(independent.begin(), independent.end(), std::back_inserter(result.independent),
               [&](const auto& value) { return value.scene == scene; });
  result.disagreements = disagreements(result.independent, result.values);
  return result;
}

TableHead headOf(const SceneReferences& references) {
  const std::size_t all = references.independent.size();
  const std::size_t agreeing = all - references.disagreements.size();
  TableHead head{{"made by", "irk reference " + references.scene},
                 {"version", std::string(buildInfo().version)},
                 {"commit", std::string(buildInfo().commit)},
                 {"independent values that agree", fmt::format("{} of {}", agreeing, all)}};
  for (const auto& line : references.disagreements) head.emplace_back("disagreement", line);
  return head;
}

void printSummary(const SceneReferences& references, std::ostream& out) {
  double worst = 0;
  const ReferenceValue* least = nullptr;
  for (const auto& value : references.values) {
    const double size = std::abs(static_cast<double>(value.value));
    const double relative = value.accuracy / size;
    if (size < value.accuracy || relative <= worst) continue;  // a zero has no digits
    worst = relative;
    least = &value;
  }
  fmt::print(out, "{}: {} values", references.scene, references.values.size());
  if (least) {
    fmt::print(out, ", fewest digits {:.0f} ({} at t = {})", std::floor(-std::log10(worst)), least->component,
               least->t);
  }
  const std::size_t all = references.independent.size();
  fmt::print(out, "; {} of {} independent values agree\n", all - references.disagreements.size(), all);
  for (const auto& line : references.disagreements) fmt::print(out, "  independent {}\n", line);
  for (const auto& line : references.problems) fmt::print(out, "  problem {}\n", line);
  out << std::flush;
}

// Returns the number of differences between a file and the computed values.
std::size_t check(const SceneReferences& references, const std::filesystem::path& file, std::ostream& out) {
  std::vector<ReferenceValue> stated;
  if (std::filesystem::exists(file)) stated = referenceValues(file.string(), readTable(file));
  const auto lines = differences(stated, references.values);
  for (const auto& line : lines) fmt::print(out, "  {}: {}\n", file.string(), line);
  return lines.size();
}

}  // namespace

int referenceCommand(const ReferenceOptions& options, Streams streams) {
  const auto scenes = scenesWanted(options.scenes);
  if (!options.out.empty() && options.into_sources) {
    throw Misuse("--out and --into-sources: one folder is expected");
  }
  if (options.check && options.into_sources) {
    throw Misuse("--check and --into-sources: checking writes nothing");
  }
  if (options.out.empty() && !options.into_sources && !options.check) {
    throw Misuse("no --out FOLDER for the files: give one, --into-sources, or --check");
  }
  const auto independent = independentValues();
  const auto folder = options.out.empty() ? referenceFolder() : std::filesystem::path(options.out);
  const InterruptScope interrupts;
  Progress progress(streams.err, "reference");
  for (const auto& scene : scenes) {
    for (const auto& task : referenceTasks()) {
      if (task.scene == scene) expectTask(task, progress);
    }
  }
  const ReferenceWatch watch{threadCount(options.jobs), &interruptFlag(), &progress};
  std::size_t wrong = 0;
  for (const auto& scene : scenes) {
    const auto references = referencesOf(scene, independent, watch);
    if (interruptFlag()) {
      streams.err << "interrupted; the files of finished scenes are kept\n";
      return kInterruptedStatus;
    }
    printSummary(references, streams.out);
    wrong += references.problems.size();
    const auto file = folder / (scene + ".csv");
    if (options.check) {
      wrong += check(references, file, streams.out);
    } else if (references.problems.empty()) {
      writeTable(file, referenceTable(headOf(references), references.values));
    }
  }
  return wrong == 0 ? 0 : 1;
}

}  // namespace irk
