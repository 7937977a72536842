#include "experiments/report/publish/claims_table.h"

#include <fmt/format.h>

#include "experiments/claims/claims_text.h"

namespace irk::report {
namespace {

TableRow claimRow(const claims::Claim& claim, const claims::Part& part, claims::Setting setting,
                  const claims::Judgement& judged) {
  const auto number = [](double x) { return fmt::format("{:.4g}", x); };
  return {claim.id,
          part.id,
          std::string(claims::settingName(setting)),
          claim.title,
          part.name,
          part.measured,
          claims::conditionText(part),
          std::string(verdictText(judged.verdict)),
          number(judged.value),
          number(judged.low),
          number(judged.high),
          part.unit,
          fmt::format("{}", judged.cases),
          fmt::format("{}", judged.scenes.size()),
          judged.reason};
}

}  // namespace

Table claimsTable(const std::vector<claims::ClaimFindings>& findings) {
  Table table{{},
              {"claim", "part", "setting", "title", "name", "measured", "condition", "verdict", "value", "low", "high",
               "unit", "cases", "scenes", "reason"},
              {}};
  for (const auto& claim : findings) {
    for (std::size_t i = 0; i < claim.parts.size(); ++i) {
      for (const claims::Setting setting : claims::kSettings) {
        const auto& judged = claim.parts[i][static_cast<std::size_t>(setting)].judged;
        table.rows.push_back(claimRow(*claim.claim, claim.claim->parts[i], setting, judged));
      }
    }
  }
  return table;
}

}  // namespace irk::report
