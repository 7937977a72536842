#include <type_traits>

#include "core/misuse.h"
#include "core/text.h"
#include "problems/build.h"
#include "problems/entries.h"

namespace irk {

const std::vector<SceneEntry>& sceneCatalogue() {
  static const std::vector<SceneEntry> entries = {
      ancfCantileverEntry(),
      ancfPendulumEntry(),
      beamChainEntry(),
      bouncingMassEntry(),
      dahlquistEntry(),
      dcMotorChopperEntry(),
      elasticaEntry(),
      elastoplasticEntry(),
      hiresEntry(),
      hydraulicArmEntry(),
      hydraulicManipulatorEntry(),
      index1NonlinearEntry(),
      index2NonlinearEntry(),
      index3NonlinearEntry(),
      kapsEntry(),
      keplerEntry(),
      mechanicalDaeEntry(),
      mechatronicCrankEntry(),
      pendulumEntry(),
      protheroRobinsonEntry(),
      riccatiTrackingEntry(),
      robertsonEntry(),
      sampledControlEntry(),
      sliderCrankEntry(),
      sliderCrankFlexibleEntry(),
      stickSlipEntry(),
      stickSlipLugreEntry(),
      vanDerPolEntry(),
  };
  return entries;
}

const SceneEntry& findScene(std::string_view id) {
  std::vector<std::string> known;
  for (const SceneEntry& entry : sceneCatalogue()) {
    if (entry.id == id) return entry;
    known.push_back(entry.id);
  }
  throw Misuse(unknownName("scene", id, known));
}

namespace {

[[noreturn]] void refuseScalar(const SceneEntry& refused) {
  std::string offering;
  for (const SceneEntry& entry : sceneCatalogue()) {
    if (entry.make_mp100) offering += (offering.empty() ? "" : ", ") + entry.id;
  }
  throw Misuse("scalar = 'mp100': scene " + refused.id +
               " offers double and mp50; with mp100: " + offering);
}

}  // namespace

template <class Real>
Scene<Real> makeScene(std::string_view id, const Settings& settings) {
  const SceneEntry& entry = findScene(id);
  const Settings completed = completedSettings(id, entry.parameters, settings);
  if constexpr (std::is_same_v<Real, double>) {
    return entry.make(completed);
  } else if constexpr (std::is_same_v<Real, mp50>) {
    return entry.make_mp50(completed);
  } else {
    if (!entry.make_mp100) refuseScalar(entry);
    return entry.make_mp100(completed);
  }
}

template Scene<double> makeScene<double>(std::string_view, const Settings&);
template Scene<mp50> makeScene<mp50>(std::string_view, const Settings&);
template Scene<mp100> makeScene<mp100>(std::string_view, const Settings&);

}  // namespace irk
