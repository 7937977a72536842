// The evaluations of the parts of claims; which belongs to which part: evaluations.cpp. All may throw MissingResults.
#pragma once

#include <cstddef>
#include <string_view>

#include "experiments/claims/measurement.h"

namespace irk::claims {

// Schemes: evaluations/schemes.cpp.
Measurement observedOrder(const ResultTables& tables, Setting setting);      // C1a
Measurement costOfHighOrder(const ResultTables& tables, Setting setting);    // C1b
Measurement fastestStages(const ResultTables& tables, Setting setting);      // C2a
Measurement limitOfManyStages(const ResultTables& tables, Setting setting);  // C2b
/// C7: `which` of the ends 0, 1, 2 of a scene.
Measurement driftOver(const ResultTables& tables, Setting setting, std::size_t which);
Measurement newmarkDifference(const ResultTables& tables, Setting setting);  // C10
/// C13: at equal errors of this column.
Measurement radauFor(const ResultTables& tables, Setting setting, std::string_view error);

// Newton's method: evaluations/newton.cpp, and what its parts cost: evaluations/parts.cpp.
Measurement massDerivativesIterations(const ResultTables& tables, Setting setting);  // C5a
Measurement massDerivativesTime(const ResultTables& tables, Setting setting);        // C5b
Measurement iterationsAtSmallSteps(const ResultTables& tables, Setting setting);     // C6a
Measurement digitsLostIndex3(const ResultTables& tables, Setting setting);           // C6b
Measurement digitsLostIndex2(const ResultTables& tables, Setting setting);           // C6c
Measurement newtonRule(const ResultTables& tables, Setting setting);                 // C12
Measurement jacobianReuse(const ResultTables& tables, Setting setting);              // C15a
Measurement shareOfEvaluations(const ResultTables& tables, Setting setting);         // C4
Measurement massFactorizations(const ResultTables& tables, Setting setting);         // C11a
Measurement firstOrderForm(const ResultTables& tables, Setting setting);             // C11b
Measurement costOfFactorization(const ResultTables& tables, Setting setting);        // C15b

// Error estimates, step control and discontinuities: evaluations/control.cpp.
Measurement costOfDoubling(const ResultTables& tables, Setting setting);  // C3a
/// C8: each BDF code over each Radau IIA, the slope of this column.
Measurement perRestart(const ResultTables& tables, std::string_view cost);
Measurement gainBetweenSwitches(const ResultTables& tables, Setting setting);  // C9a
Measurement absoluteTolerances(const ResultTables& tables, Setting setting);   // C14

// Switches, contact and friction, reliability: evaluations/switching.cpp.
/// C3b: of a group u, v, x.
Measurement reliableSteps(const ResultTables& tables, std::string_view group);
Measurement reliableRuns(const ResultTables& tables, Setting setting);  // C3br
Measurement stepAtSwitch(const ResultTables& tables, Setting setting);  // C9b
/// C16: error over tolerance of runs that treat switches so; what fails does not reach its tolerance.
Measurement reachedTolerances(const ResultTables& tables, Setting setting, std::string_view treatment);
/// C16: residuals over those of the run that locates its switches, where both succeed.
Measurement costOverLocating(const ResultTables& tables, Setting setting, std::string_view treatment);
Measurement contractionAtFirst(const ResultTables& tables, Setting setting);     // C17
Measurement repairedByFullNewton(const ResultTables& tables, Setting setting);   // C18
Measurement rejectedWithGamma(const ResultTables& tables, Setting setting);      // C19
Measurement gainOnFlexibleContact(const ResultTables& tables, Setting setting);  // C20

}  // namespace irk::claims
