#include "experiments/study/toml/scene_lists.h"

#include <algorithm>

#include "experiments/runs/fields.h"
#include "irk/collections.h"
#include "irk/misuse.h"

namespace irk {
namespace {

std::vector<std::string> scenesNamed(const std::string& item, const std::string& place) {
  if (!item.starts_with('@')) return {item};
  try {
    return scenesOf(item.substr(1));
  } catch (const Misuse& misuse) {
    throw Misuse(place + ": scene: " + misuse.what());
  }
}

}  // namespace

void expandCollections(StudyValue& scenes) {
  std::vector<std::string> ids;
  for (const auto& item : scenes.items) {
    for (const auto& id : scenesNamed(item, scenes.place)) {
      if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
    }
  }
  scenes.items = std::move(ids);
}

std::vector<std::string> sceneIds(StudyValue scenes) {
  expandCollections(scenes);
  std::vector<std::string> ids;
  for (const auto& scene : scenes.items) {
    RunSpec spec;
    try {
      findField("scene").set(spec, scene);
    } catch (const Misuse& misuse) {
      throw Misuse(scenes.place + ": scene: " + misuse.what());
    }
    ids.push_back(spec.scene);
  }
  return ids;
}

}  // namespace irk
