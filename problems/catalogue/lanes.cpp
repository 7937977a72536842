#include <algorithm>
#include <string>

#include "irk/misuse.h"
#include "irk/scene_lanes.h"

namespace irk {

namespace {

const std::string& valueOf(const Settings& settings, const Parameter& parameter) {
  const auto found = settings.find(parameter.name);
  return found == settings.end() ? parameter.default_value : found->second;
}

bool areEqual(std::span<const Settings> settings, const Parameter& parameter) {
  return std::all_of(settings.begin(), settings.end(), [&](const Settings& other) {
    return valueOf(other, parameter) == valueOf(settings.front(), parameter);
  });
}

}  // namespace

void requireLanes(const SceneEntry& entry, std::span<const Settings> settings) {
  if (!entry.make_lanes) {
    std::string known;
    for (const SceneEntry& other : sceneCatalogue()) {
      if (other.make_lanes) known += (known.empty() ? "" : ", ") + other.id;
    }
    throw Misuse("scene " + entry.id +
                 " has no lanes: its equations switch, branch on values, or are many, or its entry has no "
                 "make_lanes; scenes with lanes: " +
                 known);
  }
  for (const Parameter& p : entry.parameters) {
    const bool number = p.choices.empty() && !p.text;
    if (!number && !areEqual(settings, p)) {
      throw Misuse("scene " + entry.id + ": parameter " + p.name +
                   " is no number: the systems in lanes have one value of it");
    }
  }
}

std::shared_ptr<const System<Lanes>> makeLanes(const SceneEntry& entry, std::span<const Settings> settings,
                                               const SystemOptions& options) {
  requireLanes(entry, settings);
  if (settings.size() != kLanes) {
    throw Misuse("scene " + entry.id + " in lanes: " + std::to_string(settings.size()) + " settings, " +
                 std::to_string(kLanes) + " are expected");
  }
  Settings joined;
  for (const Parameter& p : entry.parameters) {
    std::string& text = joined[p.name] = valueOf(settings.front(), p);
    if (areEqual(settings, p)) continue;
    for (const Settings& other : settings.subspan(1)) text += ';' + valueOf(other, p);
  }
  return entry.make_lanes(joined, options);
}

}  // namespace irk
