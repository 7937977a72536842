// The treatments of switches that come with the library.
#include "core/options/entries.h"
#include "core/steps/modes.h"

namespace irk {

IRK_STRATEGIES(Discontinuity, "discontinuity")

IRK_CATALOGUE(Discontinuity, locatedModes(), ignoredModes(), iteratedModes(), smoothModes())

}  // namespace irk
