// What the evaluation of a claim returns: measured values, never a verdict.
#pragma once

#include <string>
#include <vector>

#include "experiments/claims/claim.h"
#include "experiments/claims/result_tables.h"

namespace irk::claims {

/// The value of one case, usually of a pair of runs that are compared.
struct Case {
  std::string scene;  ///< the scene's id, without its settings
  double value;       ///< NaN: the case is left out
};

struct Measurement {
  std::vector<Case> cases = {};
  /// why the part cannot be measured: which study lacks which runs; empty if it can be measured
  std::string lacking = {};
  std::string remark = {};  ///< a further observation, in a sentence; may be empty
};

inline Measurement cannotMeasure(std::string lacking) { return {{}, std::move(lacking), {}}; }

/// Measures a part in a setting. May throw MissingResults.
using Evaluation = Measurement (*)(const ResultTables&, Setting);

/// The evaluation of a part of a claim by the part's id. Throws std::logic_error for an id without one.
Evaluation evaluationOf(std::string_view part);

}  // namespace irk::claims
