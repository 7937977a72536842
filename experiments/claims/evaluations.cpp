// Which evaluation belongs to which part of claims.toml.
#include "experiments/claims/evaluations.h"

#include <fmt/format.h>

#include <stdexcept>

namespace irk::claims {

Evaluation evaluationOf(std::string_view part) {
  static constexpr std::pair<std::string_view, Evaluation> kEvaluations[] = {
      {"C1a", observedOrder},
      {"C1b", costOfHighOrder},
      {"C2a", fastestStages},
      {"C2b", limitOfManyStages},
      {"C3a", costOfDoubling},
      {"C3bu", reliableStepsU},
      {"C3bv", reliableStepsV},
      {"C3bx", reliableStepsX},
      {"C3br", reliableRuns},
      {"C4", shareOfEvaluations},
      {"C5a", massDerivativesIterations},
      {"C5b", massDerivativesTime},
      {"C6a", iterationsAtSmallSteps},
      {"C6b", digitsLostIndex3},
      {"C6c", digitsLostIndex2},
      {"C7a", driftOnce},
      {"C7b", driftTenTimes},
      {"C7c", driftHundredTimes},
      {"C8a", stepsPerRestart},
      {"C8b", timePerRestart},
      {"C8c", residualsPerRestart},
      {"C9a", gainBetweenSwitches},
      {"C9b", stepAtSwitch},
      {"C10", newmarkDifference},
      {"C11a", massFactorizations},
      {"C11b", firstOrderForm},
      {"C12", newtonRule},
      {"C13u", radauForPositions},
      {"C13v", radauForVelocities},
      {"C13z", radauForMultipliers},
      {"C14", absoluteTolerances},
      {"C15a", jacobianReuse},
      {"C15b", costOfFactorization},
      {"C16a", ignoredReach},
      {"C16b", iteratedReach},
      {"C16c", ignoredCost},
      {"C16d", iteratedCost},
      {"C17", contractionAtFirst},
      {"C18", repairedByFullNewton},
      {"C19", rejectedWithGamma},
      {"C20", gainOnFlexibleContact},
  };
  for (const auto& [id, evaluation] : kEvaluations) {
    if (id == part) return evaluation;
  }
  throw std::logic_error(fmt::format("no evaluation of part '{}' of claims.toml", part));
}

}  // namespace irk::claims
