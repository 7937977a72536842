// One evaluation per part of a claim. All may throw MissingResults.
#pragma once

#include "experiments/claims/measurement.h"

namespace irk::claims {

// Schemes: evaluations/schemes.cpp.
Measurement observedOrder(const ResultTables& tables, Setting setting);        // C1a
Measurement costOfHighOrder(const ResultTables& tables, Setting setting);      // C1b
Measurement fastestStages(const ResultTables& tables, Setting setting);        // C2a
Measurement limitOfManyStages(const ResultTables& tables, Setting setting);    // C2b
Measurement driftOnce(const ResultTables& tables, Setting setting);            // C7a
Measurement driftTenTimes(const ResultTables& tables, Setting setting);        // C7b
Measurement driftHundredTimes(const ResultTables& tables, Setting setting);    // C7c
Measurement newmarkDifference(const ResultTables& tables, Setting setting);    // C10
Measurement radauForPositions(const ResultTables& tables, Setting setting);    // C13u
Measurement radauForVelocities(const ResultTables& tables, Setting setting);   // C13v
Measurement radauForMultipliers(const ResultTables& tables, Setting setting);  // C13z

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
Measurement costOfDoubling(const ResultTables& tables, Setting setting);       // C3a
Measurement stepsPerRestart(const ResultTables& tables, Setting setting);      // C8a
Measurement timePerRestart(const ResultTables& tables, Setting setting);       // C8b
Measurement residualsPerRestart(const ResultTables& tables, Setting setting);  // C8c
Measurement gainBetweenSwitches(const ResultTables& tables, Setting setting);  // C9a
Measurement absoluteTolerances(const ResultTables& tables, Setting setting);   // C14

// Switches, contact and friction, reliability: evaluations/switching.cpp.
Measurement reliableStepsU(const ResultTables& tables, Setting setting);         // C3bu
Measurement reliableStepsV(const ResultTables& tables, Setting setting);         // C3bv
Measurement reliableStepsX(const ResultTables& tables, Setting setting);         // C3bx
Measurement reliableRuns(const ResultTables& tables, Setting setting);           // C3br
Measurement stepAtSwitch(const ResultTables& tables, Setting setting);           // C9b
Measurement ignoredReach(const ResultTables& tables, Setting setting);           // C16a
Measurement iteratedReach(const ResultTables& tables, Setting setting);          // C16b
Measurement ignoredCost(const ResultTables& tables, Setting setting);            // C16c
Measurement iteratedCost(const ResultTables& tables, Setting setting);           // C16d
Measurement contractionAtFirst(const ResultTables& tables, Setting setting);     // C17
Measurement repairedByFullNewton(const ResultTables& tables, Setting setting);   // C18
Measurement rejectedWithGamma(const ResultTables& tables, Setting setting);      // C19
Measurement gainOnFlexibleContact(const ResultTables& tables, Setting setting);  // C20

}  // namespace irk::claims
