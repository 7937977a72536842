// One evaluation per claim. The thresholds of `confirmed` stand in their reasons. Throw
// MissingResults.
#pragma once

#include "experiments/claims/claims.h"

namespace irk::claims {

// Schemes: schemes.cpp.
Finding highOrders(const ResultTables& tables);         // C1
Finding manyStages(const ResultTables& tables);         // C2
Finding driftIsNegligible(const ResultTables& tables);  // C7
Finding newmarkIsLobatto(const ResultTables& tables);   // C10
Finding radauIsBest(const ResultTables& tables);        // C13

// Newton's method: newton.cpp.
Finding phaseShares(const ResultTables& tables);          // C4
Finding massDerivatives(const ResultTables& tables);      // C5
Finding smallSteps(const ResultTables& tables);           // C6
Finding noMassFactorization(const ResultTables& tables);  // C11
Finding newtonRule(const ResultTables& tables);           // C12
Finding jacobianReuse(const ResultTables& tables);        // C15

// Control: control.cpp.
Finding stepDoubling(const ResultTables& tables);        // C3
Finding multistepRestart(const ResultTables& tables);    // C8
Finding smallStepsAtJumps(const ResultTables& tables);   // C9
Finding relativeTolerances(const ResultTables& tables);  // C14

}  // namespace irk::claims
