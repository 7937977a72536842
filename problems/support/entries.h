// The entries of the catalogue; each is defined in the file of its scene. Internal.
#pragma once

#include "irk/scene.h"

namespace irk {

SceneEntry ancfCantileverEntry();
SceneEntry ancfPendulumEntry();
SceneEntry beamChainEntry();
SceneEntry bouncingMassEntry();
SceneEntry dahlquistEntry();
SceneEntry dcMotorChopperEntry();
SceneEntry elasticaEntry();
SceneEntry elastoplasticEntry();
SceneEntry hiresEntry();
SceneEntry hydraulicArmEntry();
SceneEntry hydraulicManipulatorEntry();
SceneEntry index1NonlinearEntry();
SceneEntry index2NonlinearEntry();
SceneEntry index3NonlinearEntry();
SceneEntry kapsEntry();
SceneEntry keplerEntry();
SceneEntry mechanicalDaeEntry();
SceneEntry mechatronicCrankEntry();
SceneEntry pendulumEntry();
SceneEntry protheroRobinsonEntry();
SceneEntry riccatiTrackingEntry();
SceneEntry robertsonEntry();
SceneEntry sampledControlEntry();
SceneEntry sliderCrankEntry();
SceneEntry sliderCrankFlexibleEntry();
SceneEntry stickSlipEntry();
SceneEntry stickSlipLugreEntry();
SceneEntry vanDerPolEntry();

}  // namespace irk
