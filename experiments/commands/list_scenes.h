// `irk list scenes`.
#pragma once

#include <ostream>
#include <string>

namespace irk {

struct SceneList {
  std::string collection;  ///< empty: all scenes
  std::string scene;       ///< this one only; empty: all of the collection
  bool long_form = false;  ///< with kind, unknowns, source and parameters; so is a single scene
  bool json = false;
};

/// Prints one line per scene, the long form, or a JSON array. Throws Misuse for an unknown collection or scene.
void printScenes(const SceneList& wanted, std::ostream& out);

}  // namespace irk
