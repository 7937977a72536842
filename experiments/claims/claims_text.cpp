#include "experiments/claims/claims_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/claims/sensitivity.h"

namespace irk::claims {
namespace {

using Line = std::vector<std::string>;

constexpr std::string_view kIndent = "\n            ";

bool hasVerdict(const Judgement& judgement) {
  return judgement.verdict == Verdict::kConfirmed || judgement.verdict == Verdict::kContradicted ||
         judgement.verdict == Verdict::kUndecided;
}

// Lines of cells, each column as wide as its widest cell.
std::vector<std::string> aligned(const std::vector<Line>& lines) {
  std::vector<std::size_t> widths(lines.front().size(), 0);
  const auto widthOf = [](const std::string& cell) {  // without the second and third bytes of a character
    return static_cast<std::size_t>(
        std::count_if(cell.begin(), cell.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
  };
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], widthOf(line[i]));
  }
  std::vector<std::string> rows;
  for (const auto& line : lines) {
    std::string row;
    for (std::size_t i = 0; i < line.size(); ++i) row += line[i] + std::string(widths[i] - widthOf(line[i]) + 2, ' ');
    rows.push_back(row.substr(0, row.find_last_not_of(' ') + 1) + '\n');
  }
  return rows;
}

// Explains why a part has no verdict, and what an infinite value means.
std::string notesText(const Part& part, const std::array<Finding, 2>& findings) {
  std::string text;
  const auto& [paper, best] = findings;
  const bool same = paper.judged.reason == best.judged.reason;
  if (!paper.judged.reason.empty() && paper.judged.reason != kPreliminary) {
    text += fmt::format("{}{}: {}\n", part.name, same ? "" : ", paper", paper.judged.reason);
  }
  if (!same && !best.judged.reason.empty() && best.judged.reason != kPreliminary) {
    text += fmt::format("{}, best: {}\n", part.name, best.judged.reason);
  }
  for (const Setting setting : kSettings) {
    const Judgement& judged = findings[static_cast<std::size_t>(setting)].judged;
    if (std::isinf(judged.value))
      text += fmt::format("{}, {}: infinite; {}\n", part.name, settingName(setting), judged.remark);
  }
  return text;
}

std::string tableText(const std::vector<ClaimFindings>& all) {
  std::vector<Line> lines{{"", "paper", "", "best", "", "confirmed if"}};
  std::string notes;
  for (const auto& [claim, parts] : all) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Part& part = claim->parts[i];
      Line line{"  " + part.name};
      for (const auto& finding : parts[i]) {
        line.emplace_back(verdictText(finding.judged.verdict));
        line.push_back(numberText(part, finding.judged));
      }
      line.push_back(conditionText(part));
      lines.push_back(line);
      notes += notesText(part, parts[i]);
    }
  }
  const std::vector<std::string> rows = aligned(lines);
  std::string text = rows.front();
  auto row = rows.begin() + 1;
  for (const auto& [claim, parts] : all) {
    text += fmt::format("{}  {}\n", claim->id, claim->title);
    for (std::size_t i = 0; i < parts.size(); ++i) text += *row++;
  }
  return text + (notes.empty() ? "" : "\n" + notes);
}

std::string sensitivityText(const Part& part, const Finding& finding) {
  std::string text;
  for (const auto& line : sensitivityLines(part, finding)) text += std::string(kIndent) + line;
  return text;
}

std::string findingText(const Part& part, const Finding& finding) {
  const Judgement& judged = finding.judged;
  std::string text = std::string(verdictText(judged.verdict));
  if (judged.cases > 0) text += ", " + numberText(part, judged) + ", " + sampleText(judged);
  if (!judged.reason.empty()) text += ": " + judged.reason;
  if (!judged.remark.empty()) text += std::string(kIndent) + judged.remark;
  return text + sensitivityText(part, finding);
}

std::string claimText(const ClaimFindings& findings) {
  const Claim& claim = *findings.claim;
  std::string text = fmt::format("{}  \"{}\" ({})\n    {}\n", claim.id, claim.words, placeOf(claim), commandOf(claim));
  for (std::size_t i = 0; i < findings.parts.size(); ++i) {
    const Part& part = claim.parts[i];
    text += fmt::format("  {}: {}{}{}\n", part.name, part.measured, part.statistic == Statistic::kReport ? "" : "; ",
                        conditionText(part));
    for (const Setting setting : kSettings) {
      text += fmt::format("      {:<7}{}\n", fmt::format("{}:", settingName(setting)),
                          findingText(part, findings.parts[i][static_cast<std::size_t>(setting)]));
    }
  }
  return text;
}

}  // namespace

std::string conditionText(const Part& part) {
  const std::string unit = part.unit.empty() ? "" : " " + part.unit;
  switch (part.statistic) {
    case Statistic::kMedian:
      return rangeText(part.confirmed) + unit;
    case Statistic::kShare:
      return fmt::format("{} {:.4g} % {}", part.confirmed.low_open ? "above" : "at least", 100 * part.confirmed.low,
                         countedText(part));
    case Statistic::kExistence:
      return part.yes_or_no ? "one case shows it" : fmt::format("one case is {}{}", rangeText(part.clean), unit);
    case Statistic::kReport:
      return "";
  }
  return "";
}

std::string countedText(const Part& part) {
  if (part.statistic != Statistic::kShare) return "";
  if (part.yes_or_no) return "of the cases show it";
  return fmt::format("of the cases are {}{}", rangeText(part.clean), part.unit.empty() ? "" : " " + part.unit);
}

std::string sampleText(const Judgement& judgement) {
  std::string scenes;
  for (const auto& scene : judgement.scenes) scenes += (scenes.empty() ? "" : ", ") + scene;
  return fmt::format("{}: {}", countsText(judgement.cases, judgement.scenes.size()), scenes);
}

std::vector<std::string> sensitivityLines(const Part& part, const Finding& finding) {
  if (!hasVerdict(finding.judged)) return {};
  const Sensitivity sensitivity = sensitivityOf(part, finding.measured);
  std::vector<std::string> lines{fmt::format(
      "threshold halved ({}): {}; doubled ({}): {}", conditionText(sensitivity.halved_part),
      verdictText(sensitivity.halved), conditionText(sensitivity.doubled_part), verdictText(sensitivity.doubled))};
  for (const auto& [scene, judged] : sensitivity.without) {
    lines.push_back(judged.cases == 0 ? fmt::format("without {}: no case is left", scene)
                                      : fmt::format("without {}: {}, {}", scene, verdictText(judged.verdict),
                                                    numberText(part, judged)));
  }
  return lines;
}

std::string commandOf(const Claim& claim) {
  std::string command;
  for (const auto& study : claim.studies) {
    command += fmt::format("{}irk run {} && irk plot {}", command.empty() ? "" : " && ", study, study);
  }
  return command.empty() ? "irk claims" : command;
}

std::string claimsText(const ResultTables& tables, Detail detail) {
  std::string text = tables.areQuick()
                         ? "Results of --quick: small versions of the studies, which give no verdicts; all numbers are "
                           "preliminary.\n"
                         : "";
  const auto all = judgeClaims(protocol(), tables);
  if (detail == Detail::kTable) return text + tableText(all);
  for (const auto& findings : all) text += claimText(findings);
  return text;
}

}  // namespace irk::claims
