// Which evaluation belongs to which part of claims.toml.
#include "experiments/claims/evaluations.h"

#include <fmt/format.h>

#include <stdexcept>

namespace irk::claims {

Evaluation evaluationOf(std::string_view part) {
  using Tables = const ResultTables&;
  static constexpr std::pair<std::string_view, Evaluation> kEvaluations[] = {
      {"C1a", observedOrder},
      {"C1b", costOfHighOrder},
      {"C2a", fastestStages},
      {"C2b", limitOfManyStages},
      {"C3a", costOfDoubling},
      {"C3bu", [](Tables tables, Setting) { return reliableSteps(tables, "u"); }},
      {"C3bv", [](Tables tables, Setting) { return reliableSteps(tables, "v"); }},
      {"C3bx", [](Tables tables, Setting) { return reliableSteps(tables, "x"); }},
      {"C3br", reliableRuns},
      {"C4", shareOfEvaluations},
      {"C5a", massDerivativesIterations},
      {"C5b", massDerivativesTime},
      {"C6a", iterationsAtSmallSteps},
      {"C6b", digitsLostIndex3},
      {"C6c", digitsLostIndex2},
      {"C7a", [](Tables tables, Setting setting) { return driftOver(tables, setting, 0); }},
      {"C7b", [](Tables tables, Setting setting) { return driftOver(tables, setting, 1); }},
      {"C7c", [](Tables tables, Setting setting) { return driftOver(tables, setting, 2); }},
      {"C8a", [](Tables tables, Setting) { return perRestart(tables, "steps_accepted"); }},
      {"C8b", [](Tables tables, Setting) { return perRestart(tables, "cpu_s"); }},
      {"C8c", [](Tables tables, Setting) { return perRestart(tables, "residuals"); }},
      {"C9a", gainBetweenSwitches},
      {"C9b", stepAtSwitch},
      {"C10", newmarkDifference},
      {"C11a", massFactorizations},
      {"C11b", firstOrderForm},
      {"C12", newtonRule},
      {"C13u", [](Tables tables, Setting setting) { return radauFor(tables, setting, "error_u"); }},
      {"C13v", [](Tables tables, Setting setting) { return radauFor(tables, setting, "error_v"); }},
      {"C13z", [](Tables tables, Setting setting) { return radauFor(tables, setting, "error_z"); }},
      {"C14", absoluteTolerances},
      {"C15a", jacobianReuse},
      {"C15b", costOfFactorization},
      {"C16a", [](Tables tables, Setting setting) { return reachedTolerances(tables, setting, "ignore"); }},
      {"C16b", [](Tables tables, Setting setting) { return reachedTolerances(tables, setting, "iterate"); }},
      {"C16c", [](Tables tables, Setting setting) { return costOverLocating(tables, setting, "ignore"); }},
      {"C16d", [](Tables tables, Setting setting) { return costOverLocating(tables, setting, "iterate"); }},
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
