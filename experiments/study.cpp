#include "experiments/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "core/text.h"
#include "experiments/audit/draw.h"
#include "experiments/builtin_studies.h"
#include "experiments/numbers.h"
#include "experiments/peers/catalogue.h"
#include "experiments/study_file.h"
#include "experiments/study_rules.h"
#include "tableaus/catalogue.h"

namespace irk {
namespace {

// Keys of a block that are no fields of a spec.
constexpr std::string_view kSweepKeys[] = {"families",   "stages", "methods",
                                           "tolerances", "steps",  "refine_most"};

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

double number(const StudyKeys& keys, std::string_view key, double fallback,
              const NumberRange& range) {
  const auto* value = find(keys, key);
  if (!value) return fallback;
  return atPlace(*value, [&] { return parseNumber(key, single(key, *value), range); });
}

std::vector<double> numbers(const StudyValue& value, std::string_view key,
                            const NumberRange& range) {
  std::vector<double> all;
  for (const auto& item : value.items) {
    all.push_back(atPlace(value, [&] { return parseNumber(key, item, range); }));
  }
  return all;
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

// Numbers and ranges: 3, "1..20".
std::vector<Index> stageList(const StudyValue& value) {
  std::vector<Index> stages;
  const auto integer = [&](std::string_view text) {
    return atPlace(value, [&] { return parseInteger("stages", text, 1, kMaxStages); });
  };
  for (const std::string_view item : value.items) {
    const auto dots = item.find("..");
    const auto last = dots == item.npos ? integer(item) : integer(item.substr(dots + 2));
    for (auto s = integer(item.substr(0, dots)); s <= last; ++s) stages.push_back(s);
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

// `methods`, and `families` x `stages` from the smallest member on.
std::vector<std::string> methodList(const StudyKeys& keys) {
  std::vector<std::string> methods;
  if (const auto* listed = find(keys, "methods")) {
    for (const auto& method : listed->items) {
      if (!findPeer(method) && !isFamily(method)) {
        atPlace(*listed, [&] { return makeTableau<double>(method).stages(); });
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
  return methods;
}

// All combinations of the block's spec fields.
std::vector<RunSpec> specProduct(const StudyKeys& keys) {
  std::vector<RunSpec> specs(1);
  // A configuration sets fields that others override.
  std::vector<std::pair<std::string, StudyValue>> ordered(keys.begin(), keys.end());
  std::stable_partition(ordered.begin(), ordered.end(),
                        [](const auto& key) { return key.first == "configuration"; });
  for (const auto& [key, value] : ordered) {
    if (std::find(std::begin(kSweepKeys), std::end(kSweepKeys), key) != std::end(kSweepKeys)) {
      continue;
    }
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

Series makeSeries(const RunSpec& spec, const StudyKeys& keys) {
  if (const auto* tolerances = find(keys, "tolerances")) {
    return {{spec, Swept::kTolerances, numbers(*tolerances, "tolerances", kPositive)}, SeriesEnd::kTooLong};
  }
  if (const auto* steps = find(keys, "steps")) return {{spec, Swept::kStep, numbers(*steps, "steps", kPositive)}};
  if (!find(keys, "refine_most")) return {spec};
  constexpr NumberRange kMost{[](double x) { return x >= 2 && x <= 1e9; }, "2 <= N <= 1e9"};
  const double most = number(keys, "refine_most", 2, kMost);
  const double start = makeScene<double>(spec.scene, settingsAtStep(spec)).start.t;
  std::vector<double> steps;
  for (const int n : divisions(static_cast<int>(most))) steps.push_back((spec.t_end - start) / n);
  return {{spec, Swept::kStep, std::move(steps)}, SeriesEnd::kAsymptotic};
}

void appendBlock(const StudyKeys& keys, std::vector<Series>& all) {
  const auto& scene = *find(keys, "scene");
  if (scene.items.empty()) throw Misuse(scene.place + ": the block names no scene");
  const auto methods = methodList(keys);
  for (RunSpec spec : specProduct(keys)) {
    spec = atPlace(scene, [&] { return resolved(spec); });
    for (const auto& method : methods) {
      spec.method = method;
      if (const auto* listed = find(keys, "methods")) {
        atPlace(*listed, [&] { refuseFamilyOfFixedOrder(spec); });
      }
      all.push_back(makeSeries(spec, keys));
    }
  }
}

// Keys of a study's table that it does not have.
void refuseUnknown(const StudyKeys& keys, const std::string& table,
                   const std::vector<std::string>& names) {
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
  constexpr NumberRange kCount{[](double x) { return x >= 1 && x <= 1000; }, "1 to 1000"};
  TimingOptions timing;
  timing.wanted = find(keys, "timing") != nullptr;
  timing.min_time_s = number(keys, "timing.min_time_s", timing.min_time_s, kPositive);
  timing.repetitions =
      static_cast<int>(number(keys, "timing.repetitions", timing.repetitions, kCount));
  timing.once_above_s = number(keys, "timing.once_above_s", timing.once_above_s, kPositive);
  timing.skip_above_s = number(keys, "timing.skip_above_s", timing.skip_above_s, kPositive);
  refuseUnknown(keys, "timing", {"min_time_s", "repetitions", "once_above_s", "skip_above_s"});
  return timing;
}

AuditOptions auditOptions(const StudyKeys& keys) {
  constexpr NumberRange kCount{[](double x) { return x >= 1 && x <= 1e6; }, "1 to 1e6"};
  AuditOptions audit;
  audit.runs = static_cast<int>(number(keys, "audit.runs", audit.runs, kCount));
  audit.seed = static_cast<std::uint64_t>(number(keys, "audit.seed", 1, kNotNegative));
  audit.variants = static_cast<int>(number(keys, "audit.variants", audit.variants, kCount));
  audit.time_limit = number(keys, "audit.time_limit", audit.time_limit, kPositive);
  refuseUnknown(keys, "audit", {"runs", "seed", "variants", "time_limit"});
  return audit;
}

std::vector<Series> auditSeries(const AuditOptions& options) {
  std::vector<Series> series;
  for (const auto& run : audit::drawnRuns(options)) series.push_back({run.spec});
  return series;
}

// A file's results are in the folder of its name.
void refuseTakenName(const std::filesystem::path& file, std::string_view toml) {
  const std::string id = file.stem().string();
  const auto refuse = [&](std::string_view what) {
    throw Misuse(fmt::format("{}: '{}' is {}: give the file another name, as its results are kept under it", file.string(),
                             id, what));
  };
  for (const auto* folder : {"quick", "report", "tableaus"}) {
    if (id == folder) refuse("a folder of results");
  }
  for (const auto& study : builtinStudies()) {
    if (study.id == id && study.toml != toml) refuse("a built-in study");
  }
}

}  // namespace

std::vector<int> divisions(int most) {
  constexpr double kRatio = 1.1;
  std::vector<int> all;
  for (int n = 2; n <= most;
       n = std::max(n + 2, 2 * static_cast<int>(std::lround(n * kRatio / 2)))) {
    all.push_back(n);
  }
  return all;
}

SpecsByKey::SpecsByKey(const Study& study) : study_(study) {
  for (std::size_t i = 0; i < study.series.size(); ++i) {
    const SeriesRuns& runs = study.series[i].runs;
    for (std::size_t run = 0; run < runs.size(); ++run) places_[specKey(runs[run])] = {i, run};
  }
}

std::optional<RunSpec> SpecsByKey::find(const std::string& key) const {
  const auto found = places_.find(key);
  if (found == places_.end()) return {};
  const auto& [series, run] = found->second;
  return study_.series[series].runs[run];
}

Study parseStudy(std::string_view toml, const std::string& file, StudyVariant variant) {
  const StudyFile text = parseStudyFile(toml, file, variant);
  Study study;
  study.id = std::filesystem::path(file).stem();
  if (const auto* title = find(text.study, "title")) study.title = single("title", *title);
  study.orders = flag(text.study, "orders");
  study.trajectories = flag(text.study, "trajectories");
  study.estimates = flag(text.study, "estimates");
  study.scaling = flag(text.study, "scaling");
  study.energy = flag(text.study, "energy");
  study.phases = flag(text.study, "phases");
  if (const auto* targets = find(text.study, "targets")) {
    study.targets = numbers(*targets, "targets", kPositive);
  }
  study.profile = flag(text.study, "profile");
  study.timing = timingOptions(text.study);
  if (find(text.study, "audit")) {
    study.audit = auditOptions(text.study);
    study.states = true;
    study.series = auditSeries(*study.audit);
    return study;
  }
  for (const auto& block : text.blocks) {
    const std::size_t first = study.series.size();
    appendBlock(block, study.series);
    refuseVariableOrder(study, block, first);
  }
  return study;
}

Study loadStudy(std::string_view id_or_file, StudyVariant variant) {
  std::vector<std::string> known;
  for (const auto& study : builtinStudies()) {
    if (study.id == id_or_file)
      return parseStudy(study.toml, fmt::format("{}.toml", study.id), variant);
    known.emplace_back(study.id);
  }
  const std::filesystem::path path(id_or_file);
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path)) {
    throw Misuse(unknownName("study or file", id_or_file, known));
  }
  const std::string toml{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  refuseTakenName(path, toml);
  return parseStudy(toml, path.string(), variant);
}

}  // namespace irk
