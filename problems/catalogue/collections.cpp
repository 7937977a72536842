#include "irk/collections.h"

#include <algorithm>
#include <set>

#include "core/base/text.h"
#include "irk/misuse.h"
#include "irk/scene.h"

namespace irk {

std::vector<std::string> collections() {
  std::set<std::string> names;
  for (const SceneEntry& entry : sceneCatalogue()) names.insert(entry.collections.begin(), entry.collections.end());
  return {names.begin(), names.end()};
}

std::vector<std::string> scenesOf(std::string_view collection) {
  std::vector<std::string> ids;
  for (const SceneEntry& entry : sceneCatalogue()) {
    const auto& of = entry.collections;
    if (std::find(of.begin(), of.end(), collection) != of.end()) ids.push_back(entry.id);
  }
  if (ids.empty()) throw Misuse(unknownName("collection", collection, collections()));
  return ids;
}

std::vector<std::string> collectionsOf(std::string_view scene) {
  for (const SceneEntry& entry : sceneCatalogue()) {
    if (entry.id == scene) return entry.collections;
  }
  return {};
}

}  // namespace irk
