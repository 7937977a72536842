#include "experiments/study/study_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>

#include "core/base/input_file.h"
#include "core/base/text.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/loaded/load_method.h"
#include "experiments/study/analysis.h"
#include "experiments/study/builtin_studies.h"
#include "experiments/study/draw.h"
#include "experiments/study/study_file.h"
#include "experiments/study/study_rules.h"
#include "experiments/study/toml/block_series.h"
#include "experiments/study/toml/given_peers.h"
#include "experiments/study/toml/own_files.h"
#include "experiments/study/toml/scene_lists.h"
#include "experiments/study/toml/values.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

using namespace values;

// Numbers and ranges such as 3 and "1..20".
std::vector<Index> stageList(const StudyValue& value) {
  std::vector<Index> stages;
  const auto integer = [&](std::string_view text) {
    return atPlace(value, [&] { return parseInteger("stages", text, Range::integers(1, kMaxStages)); });
  };
  for (const std::string_view item : value.items) {
    const auto dots = item.find("..");
    const auto first = integer(item.substr(0, dots));
    const auto last = dots == item.npos ? first : integer(item.substr(dots + 2));
    if (first > last) {
      throw Misuse(fmt::format("{}: stages = '{}': the first number is above the last", value.place, item));
    }
    for (auto s = first; s <= last; ++s) {
      if (std::find(stages.begin(), stages.end(), s) != stages.end()) {
        throw Misuse(fmt::format("{}: stages: {} twice, in '{}' again", value.place, s, item));
      }
      stages.push_back(s);
    }
  }
  return stages;
}

// The ids in `methods`, or all `families` x `stages`; stages below a family's smallest member are left out.
std::vector<std::string> methodList(const StudyKeys& keys) {
  std::vector<std::string> methods;
  if (const auto* listed = find(keys, "methods")) {
    for (const auto& item : listed->items) {
      const auto method = atPlace(*listed, [&] { return loadMethod(item); });
      if (!findPeer(method) && !isFamily(method)) {
        atPlace(*listed, [&] {
          refuseUnknownMethod(method);
          return makeTableau<double>(method).stages();
        });
      }
      methods.push_back(method);
    }
  }
  const auto* families = find(keys, "families");
  const auto* stages = find(keys, "stages");
  if (families && !stages) throw Misuse(families->place + ": families need a list of stages");
  for (const auto& id : families ? families->items : std::vector<std::string>()) {
    const auto& family = atPlace(
        *families, [&]() -> const auto& { return entryNamed("family", id, familyCatalogue(), &FamilyEntry::id); });
    for (const Index s : stageList(*stages)) {
      if (s >= family.min_stages) methods.push_back(fmt::format("{}_{}", id, s));
    }
  }
  if (methods.empty()) {
    throw Misuse(find(keys, "scene")->place + ": no methods: give methods, or families and stages");
  }
  std::set<std::string_view> known;
  for (const auto& method : methods) {
    if (known.insert(method).second) continue;
    throw Misuse(fmt::format("{}: method '{}' twice, in methods and in families", families->place, method));
  }
  return methods;
}

void appendBlock(const StudyKeys& keys, SeriesList& all) {
  const auto& scene = *find(keys, "scene");
  if (scene.items.empty()) throw Misuse(scene.place + ": the block names no scene");
  refuseContradictions(keys);
  auto methods = methodList(keys);
  const auto most = integer(keys, "most_runs", kMaxRuns, 1, kMaxRunsAsked);
  refuseTooMany(keys, methods.size(), runsOfSeries(keys), most);
  const BlockSeries series(keys, methods);
  refuseUnusedByPeers(keys, methods);
  all.append(series.size(), series);
}

// Refuses keys that the study's table does not have.
void refuseUnknown(const StudyKeys& keys, const std::string& table, const std::vector<std::string>& names) {
  std::vector<std::string> known{table};
  for (const auto& name : names) known.push_back(table + "." + name);
  for (const auto& [key, value] : keys) {
    const bool unknown = std::find(known.begin(), known.end(), key) == known.end();
    if (key.starts_with(table + ".") && unknown) {
      throw Misuse(fmt::format("{}: {}", value.place, unknownName("key", key, known)));
    }
  }
}

TimingOptions timingOptions(const StudyKeys& keys) {
  constexpr std::int64_t kMaxRepetitions = 1000;
  TimingOptions timing;
  timing.wanted = find(keys, "timing") != nullptr;
  timing.min_time_s = number(keys, "timing.min_time_s", timing.min_time_s, kPositive);
  timing.repetitions = static_cast<int>(integer(keys, "timing.repetitions", timing.repetitions, 1, kMaxRepetitions));
  timing.once_above_s = number(keys, "timing.once_above_s", timing.once_above_s, kPositive);
  timing.skip_above_s = number(keys, "timing.skip_above_s", timing.skip_above_s, kPositive);
  refuseUnknown(keys, "timing", {"min_time_s", "repetitions", "once_above_s", "skip_above_s"});
  return timing;
}

AuditOptions auditOptions(const StudyKeys& keys) {
  constexpr std::int64_t kMax = 1'000'000, kLargestSeed = std::numeric_limits<std::int64_t>::max();
  AuditOptions audit;
  audit.runs = static_cast<int>(integer(keys, "audit.runs", audit.runs, 1, kMax));
  audit.seed = static_cast<std::uint64_t>(integer(keys, "audit.seed", 1, 0, kLargestSeed));
  audit.variants = static_cast<int>(integer(keys, "audit.variants", audit.variants, 1, kMax));
  audit.time_limit = number(keys, "audit.time_limit", audit.time_limit, kPositive);
  refuseUnknown(keys, "audit", {"runs", "seed", "variants", "time_limit", "scene"});
  if (const auto* scenes = find(keys, "audit.scene")) audit.scenes = sceneIds(*scenes);
  return audit;
}

SeriesList auditSeries(const AuditOptions& options) {
  const auto draw = std::make_shared<const audit::Draw>(options);
  SeriesList series;
  series.append(draw->size(), [draw](std::size_t i) { return Series{(*draw)[i].spec, SeriesEnd::kAll, {}}; });
  return series;
}

std::vector<const Analysis*> wantedAnalyses(const StudyKeys& keys) {
  std::vector<const Analysis*> wanted;
  for (const Analysis& analysis : analyses()) {
    const auto* asked = find(keys, analysis.key);
    if (!asked || (analysis.key != "targets" && !flag(keys, analysis.key))) continue;
    if (!analysis.needs.empty() && !find(keys, analysis.needs)) {
      throw Misuse(fmt::format("{}: {} without {} has no effect", asked->place, analysis.key, analysis.needs));
    }
    wanted.push_back(&analysis);
  }
  return wanted;
}

// Results go to a folder named after the study file, so two studies must not share a name.
void refuseTakenName(const std::filesystem::path& file, std::string_view toml) {
  const std::string id = file.stem().string();
  const auto refuse = [&](std::string_view what) {
    throw Misuse(fmt::format("{}: '{}' is {}: give the file another name, as its results are kept under it",
                             file.string(), id, what));
  };
  for (const auto* folder : {"quick", "report", "tableaus"}) {
    if (id == folder) refuse("a folder of results");
  }
  for (const auto& study : builtinStudies()) {
    if (study.id == id && study.toml != toml) refuse("a built-in study");
  }
}

}  // namespace

Study parseStudy(std::string_view toml, const std::string& file, StudyVariant variant,
                 const std::vector<std::string>& peers) {
  StudyFile text = parseStudyFile(toml, file, variant);
  // Also parse the other variant, so that its mistakes are found now.
  static_cast<void>(
      parseStudyFile(toml, file, variant == StudyVariant::kQuick ? StudyVariant::kFull : StudyVariant::kQuick));
  loadOwnFiles(text, file);
  addPeers(peers, text);
  Study study;
  study.id = std::filesystem::path(file).stem();
  if (const auto* title = find(text.study, "title")) study.title = single("title", *title);
  study.trajectories = flag(text.study, "trajectories");
  if (const auto* targets = find(text.study, "targets")) {
    study.targets = numbers(*targets, "targets", kPositive);
  }
  study.analyses = wantedAnalyses(text.study);
  study.timing = timingOptions(text.study);
  if (find(text.study, "audit")) {
    study.audit = auditOptions(text.study);
    study.states = true;
    study.series = auditSeries(*study.audit);
    return study;
  }
  for (auto& block : text.blocks) {
    expandCollections(block.find("scene")->second);
    const std::size_t first = study.series.size();
    appendBlock(block, study.series);
    refuseVariableOrder(study, block, first);
  }
  return study;
}

Study loadStudy(std::string_view id_or_file, StudyVariant variant, const std::vector<std::string>& peers) {
  std::vector<std::string> known;
  for (const auto& study : builtinStudies()) {
    if (study.id == id_or_file) return parseStudy(study.toml, fmt::format("{}.toml", study.id), variant, peers);
    known.emplace_back(study.id);
  }
  const std::filesystem::path path(id_or_file);
  std::error_code error;
  const auto kind = std::filesystem::status(path, error).type();
  if (kind == std::filesystem::file_type::not_found || kind == std::filesystem::file_type::none) {
    const bool named_file = path.has_parent_path() || path.extension() == ".toml";
    throw Misuse(named_file ? fmt::format("{}: there is no such file", id_or_file)
                            : unknownName("study or file", id_or_file, known));
  }
  const std::string toml = readInputFile(path);
  refuseTakenName(path, toml);
  return parseStudy(toml, path.string(), variant, peers);
}

}  // namespace irk
