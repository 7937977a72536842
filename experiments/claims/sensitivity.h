// How much a verdict depends on its threshold and on single scenes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/claims/verdict.h"

namespace irk::claims {

/// The part with its thresholds multiplied by `factor`. A range with two ends keeps its middle, and its width changes.
/// For a share the allowed part of unclean cases changes, so that 95 % becomes 97.5 % and 90 %. For an existence the
/// threshold of a case changes.
Part scaledThreshold(const Part& part, double factor);

struct Sensitivity {
  Part halved_part, doubled_part;
  Verdict halved, doubled;  ///< with these thresholds
  /// By the scene that is left out. The sample may then be smaller than a verdict needs.
  std::vector<std::pair<std::string, Judgement>> without;
};

/// The verdicts are empty (`not measurable`) if the measurement has none.
Sensitivity sensitivityOf(const Part& part, const Measurement& measured);

}  // namespace irk::claims
