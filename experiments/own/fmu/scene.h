// An FMU as a scene.
#pragma once

#include <filesystem>

#include "experiments/own/foreign/scene_library.h"

namespace irk::own {

/// The scene of an FMU: FMI 2.0 or 3.0, Model Exchange, for this platform or with sources. Its id is the name of the
/// file. Throws Misuse, beginning with the name of the file, for an FMU that cannot be used; of a program that was
/// built without libzip and pugixml always.
LibraryScene sceneOfFmu(const std::filesystem::path& fmu);

}  // namespace irk::own
