#include "experiments/study/toml/block_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "experiments/runs/setup.h"
#include "experiments/study/study.h"
#include "experiments/study/study_rules.h"
#include "experiments/study/toml/values.h"

namespace irk {
namespace {

using namespace values;

// Each tolerance is used for both rtol and atol.
std::vector<double> toleranceList(const StudyValue& value) {
  auto tolerances = numbers(value, "tolerances", kPositive);
  RunSpec spec;
  for (const auto& item : value.items) {
    for (const auto* field : {"rtol", "atol"}) atPlace(value, [&] { findField(field).set(spec, item); });
  }
  return tolerances;
}

int refineMost(const StudyKeys& keys) { return static_cast<int>(integer(keys, "refine_most", 2, 2, 1'000'000'000)); }

}  // namespace

std::size_t runsOfSeries(const StudyKeys& keys) {
  if (const auto* tolerances = find(keys, "tolerances")) return tolerances->items.size();
  if (const auto* steps = find(keys, "steps")) return steps->items.size();
  return find(keys, "refine_most") ? divisions(refineMost(keys)).size() : 1;
}

BlockSeries::BlockSeries(const StudyKeys& keys, std::vector<std::string> methods)
    : methods_(std::move(methods)), name_(find(keys, "name")->items.front()) {
  findAxes(keys);
  findSweep(keys);
  const auto& scene = *find(keys, "scene");
  const auto* listed = find(keys, "methods");
  std::map<std::pair<std::string, Settings>, double> starts;  // a scene is made once for all its combinations
  const auto startOf = [&](const RunSpec& spec) {
    const auto [at, is_new] = starts.try_emplace({spec.scene, settingsAtStep(spec)});
    if (is_new) at->second = atPlace(scene, [&] { return sceneOf<double>(spec).start.t; });
    return at->second;
  };
  for (std::size_t i = 0; i < combinations(); ++i) {
    RunSpec spec = atPlace(scene, [&] { return resolved(combination(i)); });
    t_ends_.push_back(spec.t_end);
    if (planned_) starts_.push_back(startOf(spec));
    for (const auto& method : listed ? methods_ : std::vector<std::string>()) {
      spec.method = method;
      atPlace(*listed, [&] { refuseFamilyOfFixedOrder(spec); });
    }
  }
}

Series BlockSeries::operator()(std::size_t i) const {
  const std::size_t at = i / methods_.size();
  RunSpec spec = combination(at);
  spec.t_end = t_ends_[at];  // it would be found by making the scene
  spec = resolved(spec);
  spec.method = methods_[i % methods_.size()];
  if (swept_ == Swept::kNothing) return {spec, SeriesEnd::kAll, name_};
  if (!planned_) {
    return {{spec, swept_, values_}, swept_ == Swept::kTolerances ? SeriesEnd::kTooLong : SeriesEnd::kAll, name_};
  }
  std::vector<double> steps;
  for (const double n : values_) steps.push_back(std::abs(spec.t_end - starts_[at]) / n);
  return {{spec, swept_, std::move(steps)}, SeriesEnd::kAsymptotic, name_};
}

void BlockSeries::findAxes(const StudyKeys& keys) {
  for (const auto& [key, value] : keys) {
    if (!isSpecKey(key)) continue;
    const auto& text = key;
    axes_.push_back({atPlace(value, [&] { return &findField(text); }), value});
  }
  // A configuration comes first: it sets fields that other keys override.
  std::stable_partition(axes_.begin(), axes_.end(),
                        [](const Axis& axis) { return axis.field->name == "configuration"; });
}

void BlockSeries::findSweep(const StudyKeys& keys) {
  if (const auto* tolerances = find(keys, "tolerances")) {
    swept_ = Swept::kTolerances;
    values_ = toleranceList(*tolerances);
  } else if (const auto* steps = find(keys, "steps")) {
    swept_ = Swept::kStep;
    values_ = numbers(*steps, "steps", kPositive);
  } else if (find(keys, "refine_most")) {
    swept_ = Swept::kStep;
    planned_ = true;
    for (const int n : divisions(refineMost(keys))) values_.push_back(n);
  }
}

std::size_t BlockSeries::combinations() const {
  std::size_t count = 1;
  for (const auto& axis : axes_) count *= axis.value.items.size();
  return count;
}

// The last axis changes fastest.
RunSpec BlockSeries::combination(std::size_t i) const {
  RunSpec spec;
  std::size_t count = combinations();
  for (const auto& axis : axes_) {
    count /= axis.value.items.size();
    atPlace(axis.value, [&] { axis.field->set(spec, axis.value.items[i / count]); });
    i %= count;
  }
  return spec;
}

}  // namespace irk
