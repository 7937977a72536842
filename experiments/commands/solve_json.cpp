#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>

#include "experiments/commands/commands.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/setup.h"
#include "experiments/tables/build_info.h"

namespace irk {
namespace {

using Json = nlohmann::ordered_json;

// Values as JSON numbers (null for NaN); for multiprecision runs as text with all digits.
Json numbers(const RunRecord& record, const Vec<double>& values, std::size_t& place) {
  Json list = Json::array();
  for (const double value : values) {
    if (record.digits.empty()) {
      list.push_back(value);
    } else {
      list.push_back(record.digits[place]);
    }
    ++place;
  }
  return list;
}

Json settingsObject(const Settings& settings) {
  Json object = Json::object();
  for (const auto& [name, value] : settings) object[name] = value;
  return object;
}

// Fields with numbers as JSON numbers, all others as text.
Json specObject(const RunSpec& spec) {
  Json object = Json::object();
  for (const auto& field : specFields()) {
    Json& value = object[field.name];
    if (field.name == "settings") {
      value = settingsObject(spec.settings);
    } else if (field.kind == FieldKind::kInteger) {
      value = static_cast<std::int64_t>(field.number(spec));
    } else if (field.kind == FieldKind::kNumber) {
      value = field.number(spec);
    } else {
      value = field.get(spec);
    }
  }
  return object;
}

// Runs with switches have further counters, and the times and names of their switches.
void addCounters(const RunRecord& record, Json& json) {
  constexpr std::string_view kSteps = "steps_";
  constexpr std::string_view kOfSwitches[] = {"switches", "discontinuous_iterations", "located_events", "chattering"};
  const bool has_switches = record.counters.switches != 0 || record.counters.discontinuous_iterations != 0;
  Json steps, counters;
  record.counters.forEach([&](const std::string& name, std::int64_t count) {
    if (name.starts_with(kSteps)) {
      steps[name.substr(kSteps.size())] = count;
    } else if (has_switches || std::ranges::find(kOfSwitches, name) == std::end(kOfSwitches)) {
      counters[name] = count;
    }
  });
  json["steps"] = steps;
  json["counters"] = counters;
  if (!has_switches) return;
  json["switches"] = Json::array();
  for (const auto& [t, name] : record.switches) {
    json["switches"].push_back({{"t", t}, {"name", name}});
  }
}

void addErrorBar(const RunErrorBar& bar, Json& json) {
  if (bar.u.size() + bar.v.size() + bar.x.size() + bar.z.size() == 0) return;  // not asked for
  Json& groups = json["error_bar"] = Json::object();
  for (const auto& [group, values] : {std::pair{"u", &bar.u}, {"v", &bar.v}, {"x", &bar.x}, {"z", &bar.z}})
    groups[group] = std::vector<double>(values->begin(), values->end());
  if (!std::isnan(bar.t)) json["error_bar_t"] = bar.t;
  json["error_bar_tolerances"] = bar.tolerances;
  if (!bar.component.empty()) json["error_bar_component"] = bar.component;
  if (!bar.told().empty()) json["error_bar_remark"] = bar.told();
  json["error_bar_cpu_s"] = bar.cpu_s;
}

// The components in the order of u, v, x, z.
void addNames(const Scene<double>& scene, Json& json) {
  const Sizes n = scene.sizes();
  json["names"] = json["units"] = Json::object();
  std::size_t i = 0;
  for (const auto& [group, count] : {std::pair{"u", n.nu}, {"v", n.nu}, {"x", n.nx}, {"z", n.nz}}) {
    Json& names = json["names"][group] = Json::array();
    Json& units = json["units"][group] = Json::array();
    for (Index k = 0; k < count; ++k, ++i) {
      names.push_back(i < scene.names.size() ? scene.names[i] : "");
      units.push_back(i < scene.units.size() ? scene.units[i] : "");
    }
  }
  json["units"]["t"] = scene.time_unit;
}

}  // namespace

std::string solveJson(const RunRecord& record, int indent) {
  std::size_t place = 0;
  Json json;
  json["schema"] = "irk-solve-1";
  json["version"] = buildInfo().version;
  json["outcome"] = record.outcome;
  json["t"] = record.t;
  json["u"] = numbers(record, record.u, place);
  json["v"] = numbers(record, record.v, place);
  json["x"] = numbers(record, record.x, place);
  json["z"] = numbers(record, record.z, place);
  addNames(sceneOf<double>(record.spec), json);
  json["error"] = record.errors.all;
  if (record.spec.reference_times > 1) json["error_over_time"] = record.errors_over_time.all;
  if (!std::isnan(record.errors.t)) json["error_t"] = record.errors.t;
  json["mescd"] = record.errors.mescd();
  json["scd"] = record.errors.scd();
  json["drift"] = record.errors.drift;
  json["reference"] = referenceName(record.errors.reference);
  if (!std::isnan(record.errors.accuracy)) json["reference_accuracy"] = record.errors.accuracy;
  if (!record.errors.remark.empty()) json["error_remark"] = record.errors.remark;
  addErrorBar(record.error_bar, json);
  addCounters(record, json);
  for (const auto& [name, unit, start, change] : record.invariants)
    json["invariants"][name] = {{"change", change}, {"start", start}, {"unit", unit}};
  if (!record.detail.empty()) json["detail"] = record.detail;
  json["cpu_s"] = record.cpu_s;
  json["spec"] = specObject(record.spec);
  return json.dump(indent);
}

}  // namespace irk
