#include "experiments/study/study_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>

#include "core/base/text.h"
#include "core/control/order_controller.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/unused_options.h"
#include "experiments/study/analysis.h"

namespace irk {
namespace {

const StudyValue* keyOf(const StudyKeys& keys, std::string_view key) {
  const auto at = keys.find(key);
  return at == keys.end() ? nullptr : &at->second;
}

// Keys that list the runs of a series; a block has one of them.
constexpr std::string_view kSeriesKeys[] = {"tolerances", "steps", "refine_most"};
// Keys of a block that are not fields of a spec.
constexpr std::string_view kSweepKeys[] = {"families", "stages",      "methods",   "tolerances",
                                           "steps",    "refine_most", "most_runs", "name"};

// Keys that another key of the block overrides. `fitting` is the only value that does not contradict it.
struct Overridden {
  std::string_view key, by, fitting;
};
constexpr Overridden kOverridden[] = {
    {"rtol", "tolerances", ""},    {"atol", "tolerances", ""},         {"h", "steps", ""},
    {"h", "refine_most", ""},      {"control", "steps", "fixed"},      {"control", "refine_most", "fixed"},
    {"estimate", "steps", "none"}, {"estimate", "refine_most", "none"}};

bool contains(std::span<const std::string_view> all, std::string_view key) {
  return std::find(all.begin(), all.end(), key) != all.end();
}

void refuseUnknownKeys(const StudyKeys& block) {
  std::vector<std::string> known(std::begin(kSweepKeys), std::end(kSweepKeys));
  for (const auto& field : specFields()) known.push_back(field.name);
  for (const auto& [key, value] : block) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    throw Misuse(fmt::format("{}: {}", value.place, unknownName("key", key, known)));
  }
}

}  // namespace

bool isSpecKey(std::string_view key) { return !contains(kSweepKeys, key); }

void refuseContradictions(const StudyKeys& block) {
  refuseUnknownKeys(block);
  std::string_view first;
  for (const auto key : kSeriesKeys) {
    const auto* value = keyOf(block, key);
    if (!value) continue;
    if (!first.empty()) {
      throw Misuse(fmt::format("{}: {} and {} in one block: one of tolerances, steps, refine_most is expected",
                               value->place, key, first));
    }
    first = key;
  }
  for (const auto& [key, by, fitting] : kOverridden) {
    const auto* value = keyOf(block, key);
    if (!value || !keyOf(block, by)) continue;
    if (value->items.size() == 1 && value->items.front() == fitting) continue;
    throw Misuse(fmt::format("{}: {} beside {} has no effect{}", value->place, key, by,
                             fitting.empty() ? "" : fmt::format(": only '{}' fits", fitting)));
  }
  if (const auto* method = keyOf(block, "method")) {
    throw Misuse(method->place + ": method: the key of a block is 'methods'");
  }
  if (keyOf(block, "stages") && !keyOf(block, "families")) {
    throw Misuse(keyOf(block, "stages")->place + ": stages without families have no effect");
  }
}

void refuseUnusedByPeers(const StudyKeys& block, const std::vector<std::string>& methods) {
  const auto isPeer = [](const auto& id) { return findPeer(id) != nullptr; };
  const auto peer = std::find_if(methods.begin(), methods.end(), isPeer);
  if (peer == methods.end()) return;
  const bool others = !std::all_of(methods.begin(), methods.end(), isPeer);
  const auto& taken = peerFields();
  for (const auto& [key, value] : block) {
    if (!isSpecKey(key) || key == "scene" || key == "settings") continue;
    if (std::find(taken.begin(), taken.end(), key) != taken.end()) continue;
    if (value.items.size() > 1) {
      throw Misuse(
          fmt::format("{}: {}: a list of {} has no effect on '{}', another library's integrator: give it a "
                      "block of its own",
                      value.place, key, value.items.size(), *peer));
    }
    if (others || value.common) continue;
    std::string names;
    for (const auto& field : specFields()) {
      const bool is_key = field.name != "method" && std::find(taken.begin(), taken.end(), field.name) != taken.end();
      if (is_key) names += field.name + ", ";
    }
    throw Misuse(fmt::format("{}: {} has no effect on '{}', another library's integrator; it takes {}settings",
                             value.place, key, *peer, names));
  }
}

void refuseTooMany(const StudyKeys& block, std::size_t methods, std::size_t runs_of_series, std::int64_t most) {
  double runs = static_cast<double>(methods) * static_cast<double>(runs_of_series);
  std::string lists = fmt::format("methods {}, runs of each {}", methods, runs_of_series);
  for (const auto& [key, value] : block) {
    if (!isSpecKey(key) || value.items.size() < 2) continue;
    runs *= static_cast<double>(value.items.size());
    lists += fmt::format(", {} {}", key, value.items.size());
  }
  if (runs <= static_cast<double>(most)) return;
  throw Misuse(fmt::format("{}: {:.0f} runs in one block ({}): up to {}; most_runs = N allows more",
                           keyOf(block, "scene")->place, runs, lists, most));
}

void refuseVariableOrder(const Study& study, const StudyKeys& block, std::size_t first) {
  const auto& series = study.series;
  for (const Analysis* analysis : study.analyses) {
    if (analysis->one_method.empty()) continue;
    for (std::size_t i = first; i < series.size(); ++i) {
      const RunSpec& spec = series[i].runs.front();
      if (!choosesOrder(spec.options.order) || findPeer(spec.method)) continue;
      const auto* key = keyOf(block, "order");
      if (!key) key = keyOf(block, "configuration");
      throw Misuse(fmt::format("{}: order '{}' with {} = true: {}; use order 'fixed'",
                               (key ? key : keyOf(block, "scene"))->place, spec.options.order.id, analysis->key,
                               analysis->one_method));
    }
  }
}

}  // namespace irk
