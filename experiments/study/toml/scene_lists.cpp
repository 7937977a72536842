#include "experiments/study/toml/scene_lists.h"

#include <algorithm>

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

void expandCollections(StudyKeys& keys) {
  StudyValue& scene = keys.find("scene")->second;
  std::vector<std::string> ids;
  for (const auto& item : scene.items) {
    for (const auto& id : scenesNamed(item, scene.place)) {
      if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
    }
  }
  scene.items = std::move(ids);
}

}  // namespace irk
