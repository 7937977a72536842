// Findings in words, for the terminal and for the report's page.
#pragma once

#include <string>
#include <vector>

#include "experiments/claims/claims.h"

namespace irk::claims {

/// When the part is confirmed: `1.35 to 1.65 times`, `at least 95 % of the cases at most 4`.
std::string conditionText(const Part& part);
/// Of a share, which cases it counts: `of the cases at most 4`; else empty.
std::string countedText(const Part& part);

/// `12 cases of 3 scenes: kepler, pendulum, slider_crank`.
std::string sampleText(const Judgement& judgement);

/// The verdict with thresholds halved and doubled, and with each scene left out. None for findings without a verdict.
std::vector<std::string> sensitivityLines(const Part& part, const Finding& finding);

/// `irk run X && irk plot X`, for all of the claim's studies.
std::string commandOf(const Claim& claim);

enum class Detail { kTable, kSensitivity };

/// For a terminal: a table with one line per part or, as `detail` says, all that is known of each part, with the
/// sensitivity of verdicts to thresholds and scenes.
std::string claimsText(const ResultTables& tables, Detail detail = Detail::kTable);

}  // namespace irk::claims
