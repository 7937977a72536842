#include "experiments/report/answers/paper.h"

#include <fmt/format.h>

#include <algorithm>

namespace irk::report {
namespace {

struct Group {
  std::string verdict;
  std::array<std::vector<std::string>, 2> ids;  // by setting
};

std::vector<Group> groupsOf(const std::vector<ClaimVerdicts>& claims) {
  std::vector<Group> groups;
  for (std::size_t setting = 0; setting < 2; ++setting) {
    for (const auto& claim : claims) {
      const auto& verdict = claim.verdicts[setting];
      auto at = std::ranges::find(groups, verdict, &Group::verdict);
      if (at == groups.end()) at = groups.insert(at, {verdict, {}});
      at->ids[setting].push_back(claim.id);
    }
  }
  return groups;
}

std::string countsOf(const std::vector<Group>& groups, std::size_t setting) {
  std::vector<std::string> parts;
  for (const auto& [verdict, ids] : groups) {
    const std::string_view word =
        verdict == verdictText(claims::Verdict::kDoesNotApply) ? "not applicable" : std::string_view(verdict);
    if (!ids[setting].empty()) parts.push_back(fmt::format("{} {}", ids[setting].size(), word));
  }
  return listText(parts);
}

// The claims with this verdict in the paper's setting; empty if there are none.
std::string titlesSentence(const std::vector<ClaimVerdicts>& claims, std::string_view verdict, std::string_view begin) {
  std::vector<std::string> titles;
  for (const auto& claim : claims) {
    if (claim.verdicts[0] != verdict) continue;
    titles.push_back(fmt::format("{} ({}{})", claim.title, claim.id, claim.partly[0] ? ", but a part holds" : ""));
  }
  return titles.empty() ? "" : fmt::format("{}: {}.", begin, fmt::join(titles, "; "));
}

std::string linksTo(const std::vector<std::string>& ids) {
  std::vector<std::string> links;
  for (const auto& id : ids) links.push_back(linkHtml("#" + id, id));
  return links.empty() ? "–" : fmt::format("{}", fmt::join(links, ", "));
}

bool isPartly(const claims::ClaimFindings& findings, claims::Setting setting) {
  if (findings.verdict(setting) != claims::Verdict::kContradicted) return false;
  return std::ranges::any_of(findings.parts, [&](const auto& part) {
    return part[static_cast<std::size_t>(setting)].judged.verdict == claims::Verdict::kConfirmed;
  });
}

}  // namespace

Answer paperAnswer(const claims::ResultTables& tables) {
  std::vector<ClaimVerdicts> verdicts;
  for (const auto& findings : claims::judgeClaims(claims::protocol(), tables)) {
    const auto textOf = [&](claims::Setting setting) { return std::string(verdictText(findings.verdict(setting))); };
    verdicts.push_back({findings.claim->id,
                        findings.claim->title,
                        {textOf(claims::Setting::kPaper), textOf(claims::Setting::kBest)},
                        {isPartly(findings, claims::Setting::kPaper), isPartly(findings, claims::Setting::kBest)}});
  }
  Answer answer = paperAnswer(verdicts);
  if (tables.areQuick()) answer.sentences.emplace_back("Quick runs give no verdicts: `irk paper` makes the full ones.");
  return answer;
}

Answer paperAnswer(const std::vector<ClaimVerdicts>& claims) {
  const auto groups = groupsOf(claims);
  Answer answer{.id = "paper",
                .question = "What did the paper get right?",
                .table = {{}, {"verdict", "paper_claims", "paper_ids", "best_claims", "best_ids"}, {}},
                .shown = {.caption = "Verdicts on the paper's claims",
                          .titles = {"verdict", "in the paper's setting", "which", "in the best setting", "which"}},
                .links = {{"#claims", "every claim with its measurement"}}};
  for (const auto& [verdict, ids] : groups) {
    const auto number = [](const auto& list) { return fmt::format("{}", list.size()); };
    const auto words = [](const auto& list) { return fmt::format("{}", fmt::join(list, " ")); };
    answer.table.rows.push_back({verdict, number(ids[0]), words(ids[0]), number(ids[1]), words(ids[1])});
    answer.shown.rows.push_back(
        {{escapeHtml(verdict), number(ids[0]), linksTo(ids[0]), number(ids[1]), linksTo(ids[1])}});
  }
  answer.sentences = {
      fmt::format("Of {} claims, in the setting that the paper describes: {}.", claims.size(), countsOf(groups, 0)),
      titlesSentence(claims, "confirmed", "Confirmed there"),
      titlesSentence(claims, "contradicted", "Contradicted there"),
      fmt::format("With the suite's own best settings: {}.", countsOf(groups, 1))};
  std::erase(answer.sentences, "");
  return answer;
}

}  // namespace irk::report
