#include "experiments/claims/claims.h"

#include <fmt/format.h>

#include "experiments/base/html.h"
#include "irk/misuse.h"

namespace irk::claims {
namespace {

std::string linksHtml(const Claim& claim, const std::filesystem::path& figures) {
  std::string links;
  for (const auto name : claim.figures) {
    if (!std::filesystem::exists(figures / fmt::format("{}.svg", name))) continue;
    links += fmt::format("{}<a href=\"#{}\">{}</a>", links.empty() ? "" : "<br>", name, name);
  }
  return links;
}

std::string verdictClass(Verdict verdict) {
  std::string name(verdictText(verdict));
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
}

}  // namespace

std::string_view verdictText(Verdict verdict) {
  switch (verdict) {
    case Verdict::kConfirmed:
      return "confirmed";
    case Verdict::kWithinLimits:
      return "confirmed within limits";
    case Verdict::kContradicted:
      return "contradicted";
    case Verdict::kNotMeasurable:
      return "not measurable";
  }
  return "?";
}

Finding judge(const Claim& claim, const ResultTables& tables) {
  try {
    const Finding finding = claim.evaluate(tables);
    if (!tables.areQuick()) return finding;
    return {
        Verdict::kNotMeasurable, finding.number,
        fmt::format("Results of --quick give no verdict. Here: {}. {}", verdictText(finding.verdict), finding.reason)};
  } catch (const MissingResults& missing) {
    return {Verdict::kNotMeasurable, "–", missing.what()};
  } catch (const Misuse& old) {  // a table of another version
    return {Verdict::kNotMeasurable, "–", old.what()};
  }
}

std::string commandOf(const Claim& claim) {
  std::string command;
  for (const auto study : claim.studies) {
    command += fmt::format("{}irk run {} && irk plot {}", command.empty() ? "" : " && ", study, study);
  }
  return command.empty() ? "irk claims" : command;
}

std::string claimsText(const ResultTables& tables) {
  std::string text =
      tables.areQuick() ? "Results of --quick: small versions of the studies, which give no verdicts.\n" : "";
  for (const auto& claim : claims()) {
    const Finding finding = judge(claim, tables);
    text += fmt::format("{:<4}{}: {}\n    {}\n    {}\n    {}\n", claim.id, verdictText(finding.verdict), finding.number,
                        claim.statement, finding.reason, commandOf(claim));
  }
  return text;
}

std::string claimsHtml(const ResultTables& tables, const std::filesystem::path& figures) {
  std::string html =
      "<table class=\"claims\"><thead><tr><th></th><th>The paper says</th><th>Verdict</th>"
      "<th>Measured</th><th>Why</th><th>Figures</th></tr></thead><tbody>\n";
  for (const auto& claim : claims()) {
    const Finding finding = judge(claim, tables);
    html += fmt::format(
        "<tr class=\"{}\" id=\"{}\"><th>{}</th><td>{}</td><td class=\"verdict\">{}</td><td>{}</td>"
        "<td>{}<code>{}</code></td><td>{}</td></tr>\n",
        verdictClass(finding.verdict), claim.id, claim.id, escapeHtml(claim.statement), verdictText(finding.verdict),
        escapeHtml(finding.number), escapeHtml(finding.reason), escapeHtml(commandOf(claim)),
        linksHtml(claim, figures));
  }
  return html + "</tbody></table>\n";
}

}  // namespace irk::claims
