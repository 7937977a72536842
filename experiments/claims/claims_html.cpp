#include "experiments/claims/claims_html.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/html.h"
#include "experiments/claims/claims_text.h"

namespace irk::claims {
namespace {

// `no verdict (quick)` has the class no_verdict.
std::string verdictClass(Verdict verdict) {
  std::string name(verdictText(verdict));
  name = name.substr(0, name.find(" ("));
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::string linksHtml(const Claim& claim, const std::filesystem::path& figures) {
  std::string links;
  for (const auto& name : claim.figures) {
    if (!std::filesystem::exists(figures / fmt::format("{}.svg", name))) continue;
    links += fmt::format("{}<a href=\"#{}\">{}</a>", links.empty() ? "" : ", ", name, name);
  }
  return links.empty() ? "" : fmt::format("<p class=\"figures\">Figures: {}</p>", links);
}

std::string numbersHtml(const ClaimFindings& findings, Setting setting, bool quick) {
  std::string html;
  for (std::size_t i = 0; i < findings.parts.size(); ++i) {
    const Part& part = findings.claim->parts[i];
    const Judgement& judged = findings.parts[i][static_cast<std::size_t>(setting)].judged;
    if (judged.verdict == Verdict::kDoesNotApply) continue;
    const std::string counted = judged.cases > 0 ? countedText(part) : "";
    html += fmt::format("<div class=\"number\">{}: {}{}{}</div>", escapeHtml(part.name),
                        escapeHtml(explainedNumber(part, judged)), counted.empty() ? "" : " " + escapeHtml(counted),
                        quick && judged.cases > 0 ? " <em>preliminary</em>" : "");
  }
  return html;
}

std::string verdictHtml(const ClaimFindings& findings, Setting setting, bool quick) {
  const Verdict verdict = findings.verdict(setting);
  return fmt::format("<td class=\"verdict {}\">{}{}</td>", verdictClass(verdict), verdictText(verdict),
                     numbersHtml(findings, setting, quick));
}

std::string findingHtml(const Part& part, const Finding& finding, Setting setting) {
  const Judgement& judged = finding.judged;
  std::string html = fmt::format("<li class=\"{}\">{}: {}", verdictClass(judged.verdict), settingName(setting),
                                 verdictText(judged.verdict));
  if (judged.cases > 0) html += escapeHtml(fmt::format(", {}, {}", numberText(part, judged), sampleText(judged)));
  if (!judged.reason.empty()) html += ": " + escapeHtml(judged.reason);
  if (!judged.remark.empty()) html += "<br>" + escapeHtml(judged.remark);
  const auto lines = sensitivityLines(part, finding);
  if (!lines.empty()) {
    html += "<ul class=\"sensitivity\">";
    for (const auto& line : lines) html += fmt::format("<li>{}</li>", escapeHtml(line));
    html += "</ul>";
  }
  return html + "</li>";
}

std::string protocolHtml(const ClaimFindings& findings) {
  std::string html;
  for (std::size_t i = 0; i < findings.parts.size(); ++i) {
    const Part& part = findings.claim->parts[i];
    const std::string condition = conditionText(part);
    html += fmt::format("<p class=\"part\"><b>{}</b> ({}). {}{}</p><ul>", escapeHtml(part.name), part.id,
                        escapeHtml(part.measured), condition.empty() ? "" : "; confirmed if " + escapeHtml(condition));
    for (const Setting setting : kSettings) {
      html += findingHtml(part, findings.parts[i][static_cast<std::size_t>(setting)], setting);
    }
    html += "</ul>";
  }
  return html;
}

std::string historyHtml(const Claim& claim) {
  std::string html = "<p>History of this protocol:</p><ul class=\"history\">";
  for (const auto& [date, change, reason] : claim.history) {
    html += fmt::format("<li><time>{}</time> {} {}</li>", date, escapeHtml(change), escapeHtml(reason));
  }
  return html + "</ul>";
}

}  // namespace

std::string claimsHtml(const ResultTables& tables, const std::filesystem::path& figures) {
  std::string html =
      "<p class=\"note\">How to read a verdict. A claim has one or more parts. Each part is a number "
      "that is "
      "measured in many cases: runs of a scene by a method. “7 [5, 10.5] stages” is the median of the cases with its "
      "90&nbsp;% interval, which resampling of the scenes gives; a percentage is the share of the cases that fulfil "
      "the "
      "condition; “5 of 20 cases” belongs to a claim that something can happen, which needs one case. Confirmed: the "
      "whole interval fulfils the condition; contradicted: nothing of it does; undecided: the threshold lies within; "
      "not "
      "measurable: fewer than ten cases of three scenes; reported: a number without a condition. One contradicted part "
      "contradicts the claim. In its setting: as the paper describes the program; best setting: the configurations "
      "<code>embedded</code> and <code>variable</code> of this suite.</p>\n"
      "<table class=\"claims\"><thead><tr><th></th><th>The paper says</th><th>In its setting</th>"
      "<th>In the best setting</th></tr></thead><tbody>\n";
  for (const auto& findings : judgeClaims(protocol(), tables)) {
    const Claim& claim = *findings.claim;
    html += fmt::format(
        "<tr class=\"claim\" id=\"{}\"><th>{}</th><td class=\"words\"><q>{}</q> <span "
        "class=\"section\">({})</span>\n<details class=\"protocol\"><summary>Protocol, sensitivity, "
        "history</summary>{}{}"
        "<p><code>{}</code></p>{}</details></td>\n{}{}</tr>\n",
        claim.id, claim.id, escapeHtml(claim.words), escapeHtml(placeOf(claim)), protocolHtml(findings),
        historyHtml(claim), escapeHtml(commandOf(claim)), linksHtml(claim, figures),
        verdictHtml(findings, Setting::kPaper, tables.areQuick()),
        verdictHtml(findings, Setting::kBest, tables.areQuick()));
  }
  return html + "</tbody></table>\n";
}

}  // namespace irk::claims
