// The evaluations of the parts of claims. Each file in evaluations/ has a list of its own, which the build finds by the
// file's name: `Evaluations NAMEEvaluations()` in NAME.cpp.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "experiments/claims/measurement.h"

namespace irk::claims {

/// The evaluation of one part, as "C3a".
struct PartEvaluation {
  std::string_view part;
  Evaluation evaluate;
};
using Evaluations = std::vector<PartEvaluation>;

/// The lists of all files.
std::span<const Evaluations> evaluationLists();

}  // namespace irk::claims
