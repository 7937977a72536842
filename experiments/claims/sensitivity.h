// How much a verdict depends on its threshold and on single scenes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/claims/verdict.h"

namespace irk::claims {

/// The part with its thresholds times `factor`. Of a range with two ends the width is changed about its middle; of a
/// share the part of the cases that may be unclean, so that 95 % becomes 97.5 % and 90 %. Existence: the threshold of a
/// case.
Part scaledThreshold(const Part& part, double factor);

struct Sensitivity {
  Part halved_part, doubled_part;
  Verdict halved, doubled;  ///< with these thresholds
  /// By the scene that is left out. The sample may then be smaller than a verdict needs.
  std::vector<std::pair<std::string, Judgement>> without;
};

/// Empty verdicts (`not measurable`) where the measurement has none.
Sensitivity sensitivityOf(const Part& part, const Measurement& measured);

}  // namespace irk::claims
