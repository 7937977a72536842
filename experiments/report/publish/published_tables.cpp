#include "experiments/report/publish/published_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/failure.h"
#include "experiments/claims/claims.h"
#include "experiments/report/publish/claims_table.h"

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
