// The entries behind the catalogue, one per scene file. Internal.
#pragma once

#include "problems/scene.h"

namespace irk {

SceneEntry ancfCantileverEntry();
SceneEntry ancfPendulumEntry();
SceneEntry dahlquistEntry();
SceneEntry hiresEntry();
SceneEntry hydraulicArmEntry();
SceneEntry keplerEntry();
SceneEntry pendulumEntry();
SceneEntry protheroRobinsonEntry();
SceneEntry riccatiTrackingEntry();
SceneEntry robertsonEntry();
SceneEntry sliderCrankEntry();
SceneEntry sliderCrankFlexibleEntry();
SceneEntry stickSlipEntry();
SceneEntry vanDerPolEntry();

}  // namespace irk
