#include "core/steps/modes.h"

#include "core/modes/modes_follow.h"
#include "core/modes/modes_iterate.h"
#include "core/modes/modes_locate.h"

namespace irk {

IRK_STRATEGIES(Discontinuity, "discontinuity")

template <>
Catalogue<Discontinuity>& catalogue<Discontinuity>() {
  static Catalogue<Discontinuity> all({locatedModes(), ignoredModes(), iteratedModes(), smoothModes()});
  return all;
}

}  // namespace irk
