// Scenes of the program from scenes behind irk/scene_c.h.
#pragma once

#include <memory>
#include <string>

#include "experiments/own/foreign/scene_functions.h"

namespace irk::own {

/// The scene with these values of its parameters. Throws Misuse for what is wrong with its functions, naming the
/// function, and for a start that is not consistent.
Scene<double> foreignScene(const ForeignSource& source, const Settings& settings);

/// The entry of a scene with this id. Opens it with the defaults of its parameters. Throws Misuse as foreignScene.
SceneEntry foreignEntry(ForeignSource source, const std::string& id, const std::string& title);

/// An id from the name of a file: small letters, digits and '_' for all others.
std::string idFromFile(const std::string& stem);

}  // namespace irk::own
