// Scenes in lanes: the equations of eight sets of parameters side by side, for ensembles (irk/ensemble.h).
//
// A scene's struct can be used in lanes if its residual and constraints do not branch on values; a struct that does is
// refused by the compiler (irk/lanes.h). The scene's entry says so:
//
//   .make_lanes = lanesOf<FourBar>
#pragma once

#include <memory>
#include <span>

#include "irk/lanes.h"
#include "irk/scene.h"

namespace irk {

/// The LanesMaker of a struct with a function `with`, or without parameters. `static` for the same reason as
/// sceneEntryOf.
template <template <class> class S>
static std::shared_ptr<const System<Lanes>> lanesOf(const Settings& values, const SystemOptions& options) {
  using P = S<Lanes>;
  if constexpr (requires { P::with(values); }) {
    return std::make_shared<const ProblemSystem<P, Lanes>>(P::with(values), options);
  } else {
    return std::make_shared<const ProblemSystem<P, Lanes>>(P{}, options);
  }
}

/// Throws Misuse, with the reason, for a scene without lanes, and for settings of which lanes cannot have several:
/// words and texts.
void requireLanes(const SceneEntry& entry, std::span<const Settings> settings);

/// The scene's systems with kLanes settings, of which each is checked (completedSettings), side by side: lane i has
/// those of settings[i]. Throws Misuse as requireLanes, and for another number of settings.
std::shared_ptr<const System<Lanes>> makeLanes(const SceneEntry& entry, std::span<const Settings> settings,
                                               const SystemOptions& options);

}  // namespace irk
