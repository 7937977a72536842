#include "experiments/study/study_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
#include "experiments/runs/setup.h"
#include "experiments/study/analysis.h"
#include "experiments/study/builtin_studies.h"
#include "experiments/study/draw.h"
#include "experiments/study/study_file.h"
#include "experiments/study/study_rules.h"
#include "experiments/study/toml/own_files.h"
#include "experiments/study/toml/scene_lists.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

template <class F>
auto atPlace(const StudyValue& value, F&& f) {
  try {
    return f();
  } catch (const Misuse& misuse) {
    throw Misuse(fmt::format("{}: {}", value.place, misuse.what()));
  }
}

const StudyValue* find(const StudyKeys& keys, std::string_view key) {
  const auto at = keys.find(key);
  return at == keys.end() ? nullptr : &at->second;
}

const std::string& single(std::string_view key, const StudyValue& value) {
  if (value.items.size() != 1) {
    throw Misuse(fmt::format("{}: {}: one value is expected, not a list", value.place, key));
  }
  return value.items.front();
}

double number(const StudyKeys& keys, std::string_view key, double fallback, const Range& range) {
  const auto* value = find(keys, key);
  if (!value) return fallback;
  return atPlace(*value, [&] { return parseNumber(key, single(key, *value), range); });
}

std::int64_t integer(const StudyKeys& keys, std::string_view key, std::int64_t fallback, std::int64_t min,
                     std::int64_t max) {
  const auto* value = find(keys, key);
  if (!value) return fallback;
  return atPlace(*value, [&] { return parseInteger(key, single(key, *value), Range::integers(min, max)); });
}

std::vector<double> numbers(const StudyValue& value, std::string_view key, const Range& range) {
  std::vector<double> all;
  for (const auto& item : value.items) {
    all.push_back(atPlace(value, [&] { return parseNumber(key, item, range); }));
  }
  return all;
}

// Each tolerance is used for both rtol and atol.
std::vector<double> toleranceList(const StudyValue& value) {
  auto tolerances = numbers(value, "tolerances", kPositive);
  RunSpec spec;
  for (const auto& item : value.items) {
    for (const auto* field : {"rtol", "atol"}) atPlace(value, [&] { findField(field).set(spec, item); });
  }
  return tolerances;
}

bool flag(const StudyKeys& keys, std::string_view key) {
  const auto* value = find(keys, key);
  if (!value) return false;
  const auto& text = single(key, *value);
  if (text != "true" && text != "false") {
    throw Misuse(fmt::format("{}: {} = '{}': true or false", value->place, key, text));
  }
  return text == "true";
}

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

const FamilyEntry& findFamily(std::string_view id) {
  std::vector<std::string> known;
  for (const auto& family : familyCatalogue()) {
    if (family.id == id) return family;
    known.push_back(family.id);
  }
  throw Misuse(unknownName("family", id, known));
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
        *families, [&]() -> const auto& { return findFamily(id); });
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

// All combinations of the values of the block's spec fields.
std::vector<RunSpec> specProduct(const StudyKeys& keys) {
  std::vector<RunSpec> specs(1);
  // A configuration comes first: it sets fields that other keys override.
  std::vector<std::pair<std::string, StudyValue>> ordered(keys.begin(), keys.end());
  std::stable_partition(ordered.begin(), ordered.end(), [](const auto& key) { return key.first == "configuration"; });
  for (const auto& entry : ordered) {
    const std::string& key = entry.first;
    const StudyValue& value = entry.second;
    if (!isSpecKey(key)) continue;
    const auto& field = atPlace(
        value, [&]() -> const auto& { return findField(key); });
    std::vector<RunSpec> product;
    for (const auto& spec : specs) {
      for (const auto& item : value.items) {
        product.push_back(spec);
        atPlace(value, [&] { field.set(product.back(), item); });
      }
    }
    specs = std::move(product);
  }
  return specs;
}

int refineMost(const StudyKeys& keys) { return static_cast<int>(integer(keys, "refine_most", 2, 2, 1'000'000'000)); }

Series makeSeries(const RunSpec& spec, const StudyKeys& keys) {
  if (const auto* tolerances = find(keys, "tolerances")) {
    return {{spec, Swept::kTolerances, toleranceList(*tolerances)}, SeriesEnd::kTooLong};
  }
  if (const auto* steps = find(keys, "steps")) return {{spec, Swept::kStep, numbers(*steps, "steps", kPositive)}};
  if (!find(keys, "refine_most")) return {spec};
  const double start = atPlace(*find(keys, "scene"), [&] { return sceneOf<double>(spec).start.t; });
  std::vector<double> steps;
  for (const int n : divisions(refineMost(keys))) steps.push_back((spec.t_end - start) / n);
  return {{spec, Swept::kStep, std::move(steps)}, SeriesEnd::kAsymptotic};
}

std::size_t runsOfSeries(const StudyKeys& keys) {
  if (const auto* tolerances = find(keys, "tolerances")) return tolerances->items.size();
  if (const auto* steps = find(keys, "steps")) return steps->items.size();
  return find(keys, "refine_most") ? divisions(refineMost(keys)).size() : 1;
}

void appendBlock(const StudyKeys& keys, std::vector<Series>& all) {
  const auto& scene = *find(keys, "scene");
  if (scene.items.empty()) throw Misuse(scene.place + ": the block names no scene");
  refuseContradictions(keys);
  const auto methods = methodList(keys);
  const auto most = integer(keys, "most_runs", kMaxRuns, 1, kMaxRunsAsked);
  refuseTooMany(keys, methods.size(), runsOfSeries(keys), most);
  const auto specs = specProduct(keys);
  refusePeersInSweeps(keys, methods);
  for (RunSpec spec : specs) {
    spec = atPlace(scene, [&] { return resolved(spec); });
    for (const auto& method : methods) {
      spec.method = method;
      if (const auto* listed = find(keys, "methods")) {
        atPlace(*listed, [&] { refuseFamilyOfFixedOrder(spec); });
      }
      all.push_back(makeSeries(spec, keys));
      all.back().block = find(keys, "name")->items.front();
    }
  }
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

std::vector<Series> auditSeries(const AuditOptions& options) {
  std::vector<Series> series;
  for (const auto& run : audit::drawnRuns(options)) series.push_back({run.spec});
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

Study parseStudy(std::string_view toml, const std::string& file, StudyVariant variant) {
  StudyFile text = parseStudyFile(toml, file, variant);
  // Also parse the other variant, so that its mistakes are found now.
  static_cast<void>(
      parseStudyFile(toml, file, variant == StudyVariant::kQuick ? StudyVariant::kFull : StudyVariant::kQuick));
  loadOwnFiles(text, file);
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

Study loadStudy(std::string_view id_or_file, StudyVariant variant) {
  std::vector<std::string> known;
  for (const auto& study : builtinStudies()) {
    if (study.id == id_or_file) return parseStudy(study.toml, fmt::format("{}.toml", study.id), variant);
    known.emplace_back(study.id);
  }
  const std::filesystem::path path(id_or_file);
  std::error_code error;
  const auto kind = std::filesystem::status(path, error).type();
  if (kind == std::filesystem::file_type::not_found || kind == std::filesystem::file_type::none) {
    throw Misuse(unknownName("study or file", id_or_file, known));
  }
  const std::string toml = readInputFile(path);
  refuseTakenName(path, toml);
  return parseStudy(toml, path.string(), variant);
}

}  // namespace irk
