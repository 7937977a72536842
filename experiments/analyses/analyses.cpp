#include "experiments/study/analysis.h"

namespace irk {

// Each in the file of its name.
Analysis ordersAnalysis();
Analysis costAnalysis();
Analysis profileAnalysis();
Analysis ratiosAnalysis();
Analysis robustnessAnalysis();
Analysis estimatesAnalysis();
Analysis scalingAnalysis();
Analysis energyAnalysis();
Analysis phasesAnalysis();
Analysis contractionsAnalysis();

std::span<const Analysis> analyses() {
  static const Analysis all[] = {ordersAnalysis(),     costAnalysis(),        profileAnalysis(), ratiosAnalysis(),
                                 robustnessAnalysis(), estimatesAnalysis(),   scalingAnalysis(), energyAnalysis(),
                                 phasesAnalysis(),     contractionsAnalysis()};
  return all;
}

}  // namespace irk
