#include <algorithm>
#include <map>

#include "irk/misuse.h"
#include "irk/scene_lanes.h"

namespace irk {

// A function of each scene's file.
LanesMaker caraxisLanes();
LanesMaker chemakzoLanes();
LanesMaker dahlquistLanes();
LanesMaker e5Lanes();
LanesMaker hiresLanes();
LanesMaker kapsLanes();
LanesMaker keplerLanes();
LanesMaker mechanicalDaeLanes();
LanesMaker oregoLanes();
LanesMaker pendulumLanes();
LanesMaker protheroRobinsonLanes();
LanesMaker robertsonLanes();
LanesMaker vanDerPolLanes();

namespace {

// By the ids of scenes.
std::map<std::string, LanesMaker, std::less<>>& makers() {
  static std::map<std::string, LanesMaker, std::less<>> all{
      {"caraxis", caraxisLanes()},
      {"chemakzo", chemakzoLanes()},
      {"dahlquist", dahlquistLanes()},
      {"e5", e5Lanes()},
      {"hires", hiresLanes()},
      {"kaps", kapsLanes()},
      {"kepler", keplerLanes()},
      {"mechanical_dae", mechanicalDaeLanes()},
      {"orego", oregoLanes()},
      {"pendulum", pendulumLanes()},
      {"prothero_robinson", protheroRobinsonLanes()},
      {"robertson", robertsonLanes()},
      {"van_der_pol", vanDerPolLanes()},
  };
  return all;
}

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

void registerLanes(const std::string& scene, LanesMaker maker) {
  if (!makers().emplace(scene, maker).second) throw Misuse("scene " + scene + " has lanes already");
}

void requireLanes(const SceneEntry& entry, std::span<const Settings> settings) {
  if (!makers().contains(entry.id)) {
    std::string known;
    for (const auto& [id, maker] : makers()) known += (known.empty() ? "" : ", ") + id;
    throw Misuse("scene " + entry.id +
                 " has no lanes: its equations switch, branch on values, are many, or nobody has declared them "
                 "(IRK_LANES); scenes with lanes: " +
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
  Settings joined;
  for (const Parameter& p : entry.parameters) {
    std::string& text = joined[p.name] = valueOf(settings.front(), p);
    if (areEqual(settings, p)) continue;
    for (const Settings& other : settings.subspan(1)) text += ';' + valueOf(other, p);
  }
  return makers().at(entry.id)(joined, options);
}

}  // namespace irk
