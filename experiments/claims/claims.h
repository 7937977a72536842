// The paper's claims, and what the tables of results say about each.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/claims/result_tables.h"

namespace irk::claims {

enum class Verdict { kConfirmed, kWithinLimits, kContradicted, kNotMeasurable };

/// `confirmed`, `confirmed within limits`, `contradicted`, `not measurable`.
std::string_view verdictText(Verdict verdict);

/// What the data say.
struct Finding {
  Verdict verdict = Verdict::kNotMeasurable;
  std::string number;  ///< the measured value with its unit, in a few words
  std::string reason;  ///< one or two sentences, the thresholds included
};

struct Claim {
  std::string_view id;         ///< C1, ...
  std::string_view statement;  ///< what the paper says
  std::vector<std::string_view> studies;
  std::vector<std::string_view> figures;  ///< names in plots/figures.txt
  /// Throws MissingResults where a table is not there.
  Finding (*evaluate)(const ResultTables&);
};

/// C1 to C15.
std::span<const Claim> claims();

/// The claim's evaluation, or `not measurable`: study X has not been run, or the results are those of --quick, whose
/// studies are too small for a verdict; the reason then says what they would give.
Finding judge(const Claim& claim, const ResultTables& tables);

/// `irk run X && irk plot X`, for all of its studies.
std::string commandOf(const Claim& claim);

/// The table of claims for a terminal, and for the report's page.
std::string claimsText(const ResultTables& tables);
std::string claimsHtml(const ResultTables& tables, const std::filesystem::path& figures);

}  // namespace irk::claims
