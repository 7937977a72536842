// A scene in a user's shared library (irk/scene_c.h).
#pragma once

#include <filesystem>
#include <string>

#include "irk/scene.h"

namespace irk::own {

/// Whether the library exports a scene. Throws Misuse for a file that cannot be loaded.
bool holdsScene(const std::filesystem::path& library);

struct LibraryScene {
  SceneEntry entry;
  std::string hash;  ///< of the file
};

/// The scene of a library; its id is the name of the file without `.so`. The library stays loaded. Throws Misuse,
/// naming the file, for a missing function, another version of the interface, and what foreignEntry refuses.
LibraryScene sceneOfLibrary(const std::filesystem::path& library);

}  // namespace irk::own
