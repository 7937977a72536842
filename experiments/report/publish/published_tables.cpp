#include "experiments/report/publish/published_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/failure.h"
#include "experiments/claims/claims.h"
#include "experiments/claims/claims_text.h"
#include "experiments/tables/named_cells.h"

namespace irk::report {
namespace {

constexpr PublishedTable kPublishedTables[] = {
    {"", "solver", "a kind of problem at one error: the fastest solver", "kind target_error"},
    {"", "orders", "the order of one component for one family", "system component family"},
    {"", "failures", "a solver: how its runs end", "solver"},
    {"", "claims", "a part of one of the paper's claims in a setting", "part setting"},
    {"robustness", "robustness", "runs of a solver on a collection: right, failed, wrong",
     "integrator collection tolerance"},
    {"audit", "audit_summary", "a group of runs that were drawn at random: right, failed, wrong", "by group"},
    {"audit", "audit_error_bar", "a group of runs: what error bars are worth", "by group"},
    {"audit", "audit_own_word", "a solver: how often its own word is wrong", "by group"},
};

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

// Verdicts and numbers of all claims: a row per part of a claim and setting (claims::kSettings). Columns: claim, part,
// setting, title, name, measured, condition, verdict, value, low, high (the 90 % interval), unit, cases, scenes,
// reason. `value` is nan without cases. No head.
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

Table contentOf(const PublishedTable& table, const ReportOptions& options, const std::vector<Answer>& answers) {
  if (table.name == "claims") {
    return claimsTable(claims::judgeClaims(claims::protocol(), claims::ResultTables(options.results)));
  }
  if (!table.study.empty()) {
    const auto file = options.results / table.study / fmt::format("{}.csv", table.name);
    if (std::filesystem::exists(file)) return readTable(file);
    throw Failure(fmt::format("no {}: irk run {} makes it", file.string(), table.study));
  }
  const auto answer = std::ranges::find(answers, table.name, &Answer::id);
  if (answer != answers.end() && !answer->table.columns.empty()) return answer->table;
  throw Failure(fmt::format("the answer '{}' has no table: its studies are not complete", table.name));
}

}  // namespace

std::span<const PublishedTable> publishedTables() { return kPublishedTables; }

std::vector<Table> readPublishedTables(const ReportOptions& options, const std::vector<Answer>& answers) {
  std::vector<Table> tables;
  for (const auto& table : kPublishedTables) {
    tables.push_back(contentOf(table, options, answers));
    auto& head = tables.back().head;
    head.clear();
    if (!table.study.empty()) head.emplace_back("study", table.study);
    head.emplace_back("key", table.key);
    if (areQuick(options)) head.emplace_back("quick", "small versions of the studies; preliminary");
  }
  return tables;
}

}  // namespace irk::report
