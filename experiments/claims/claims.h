// The verdicts on the paper's claims from the tables of results.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/claims/claim.h"
#include "experiments/claims/result_tables.h"
#include "experiments/claims/verdict.h"

namespace irk::claims {

/// The reason given for numbers without a verdict.
inline constexpr std::string_view kPreliminary = "preliminary: results of --quick give no verdict";

/// A part of a claim in one setting.
struct Finding {
  Measurement measured;
  Judgement judged;
};

/// Measures a part and judges it. The result is `not measurable`, with the reason, if a study has not been run, if its
/// table is of another version, or if these are results of --quick, which give no verdict (the number is kept).
/// `multibody`: the scenes that vote on parts about multibody systems. `evaluate`: null for the part's own evaluation.
Finding findingOn(const Part& part, Setting setting, const ResultTables& tables,
                  const std::vector<std::string>& multibody, Evaluation evaluate = nullptr);

struct ClaimFindings {
  const Claim* claim;
  std::vector<std::array<Finding, 2>> parts;  ///< in the order of the claim's parts; by setting

  Verdict verdict(Setting setting) const;
};

/// All claims of the protocol, which must outlive the result.
std::vector<ClaimFindings> judgeClaims(const Protocol& protocol, const ResultTables& tables);

}  // namespace irk::claims
