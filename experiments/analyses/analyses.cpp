#include "experiments/study/analysis.h"

namespace irk {

// In the order of execution, each a function of the file of its name. This line declares them, the array calls them.
#define IRK_ANALYSES                                                                                           \
  ordersAnalysis(), costAnalysis(), profileAnalysis(), ratiosAnalysis(), robustnessAnalysis(), gapsAnalysis(), \
      estimatesAnalysis(), scalingAnalysis(), energyAnalysis(), phasesAnalysis(), contractionsAnalysis(),      \
      parallelAnalysis()

Analysis IRK_ANALYSES;

std::span<const Analysis> analyses() {
  static const Analysis all[] = {IRK_ANALYSES};
  return all;
}
#undef IRK_ANALYSES

}  // namespace irk
