#include "experiments/report/answers/paper.h"

#include <fmt/format.h>

#include <algorithm>

namespace irk::report {

Answer paperAnswer(const claims::ResultTables& tables) {
  Verdicts verdicts;
  for (const auto& claim : claims::claims()) {
    verdicts.emplace_back(claim.id, claims::verdictText(claims::judge(claim, tables).verdict));
  }
  Answer answer = paperAnswer(verdicts);
  if (tables.areQuick()) answer.sentences.emplace_back("Quick runs give no verdicts: `irk paper` makes the full ones.");
  return answer;
}

Answer paperAnswer(const Verdicts& verdicts) {
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;  // verdict, ids
  for (const auto& [id, verdict] : verdicts) {
    const auto same = [&verdict = verdict](const auto& group) { return group.first == verdict; };
    auto at = std::find_if(groups.begin(), groups.end(), same);
    if (at == groups.end()) at = groups.insert(at, {verdict, {}});
    at->second.push_back(id);
  }
  Answer answer{.id = "paper",
                .question = "What did the paper get right?",
                .table = {{}, {"verdict", "claims", "ids"}, {}},
                .shown = {.caption = "Verdicts on the paper's claims", .titles = {"verdict", "claims", "which"}},
                .links = {{"#claims", "every claim with its measurement"}}};
  std::vector<std::string> parts;
  for (const auto& [verdict, ids] : groups) {
    parts.push_back(fmt::format("{} {}", ids.size(), verdict));
    std::vector<std::string> links;
    for (const auto& id : ids) links.push_back(linkHtml("#" + id, id));
    answer.table.rows.push_back({verdict, fmt::format("{}", ids.size()), fmt::format("{}", fmt::join(ids, " "))});
    answer.shown.rows.push_back(
        {{escapeHtml(verdict), fmt::format("{}", ids.size()), fmt::format("{}", fmt::join(links, ", "))}});
  }
  answer.sentences = {fmt::format("Of {} claims: {}.", verdicts.size(), listText(parts))};
  return answer;
}

}  // namespace irk::report
