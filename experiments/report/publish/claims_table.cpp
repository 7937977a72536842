#include "experiments/report/publish/claims_table.h"

#include <fmt/format.h>

#include "experiments/claims/claims_text.h"
#include "experiments/tables/named_cells.h"

namespace irk::report {
namespace {

NamedCells claimCells(const claims::Claim& claim, const claims::Part& part, claims::Setting setting,
                      const claims::Judgement& judged) {
  const auto number = [](double x) { return fmt::format("{:.4g}", x); };
  return {{"claim", claim.id},
          {"part", part.id},
          {"setting", std::string(claims::settingName(setting))},
          {"title", claim.title},
          {"name", part.name},
          {"measured", part.measured},
          {"condition", claims::conditionText(part)},
          {"verdict", std::string(verdictText(judged.verdict))},
          {"value", number(judged.value)},
          {"low", number(judged.low)},
          {"high", number(judged.high)},
          {"unit", part.unit},
          {"cases", fmt::format("{}", judged.cases)},
          {"scenes", fmt::format("{}", judged.scenes.size())},
          {"reason", judged.reason}};
}

}  // namespace

Table claimsTable(const std::vector<claims::ClaimFindings>& findings) {
  Table table;
  for (const auto& claim : findings) {
    for (std::size_t i = 0; i < claim.parts.size(); ++i) {
      for (const claims::Setting setting : claims::kSettings) {
        const auto& judged = claim.parts[i][static_cast<std::size_t>(setting)].judged;
        addRow(table, claimCells(*claim.claim, claim.claim->parts[i], setting, judged));
      }
    }
  }
  return table;
}

}  // namespace irk::report
