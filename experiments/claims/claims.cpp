#include "experiments/claims/claims.h"

#include <fmt/format.h>

#include "experiments/base/html.h"
#include "experiments/claims/evaluations.h"
#include "irk/misuse.h"

namespace irk::claims {
namespace {

const std::vector<Claim>& catalogue() {
  static const std::vector<Claim> all = {
      {"C1",
       "Orders up to 20 (10-stage Gauss) are reached, and are even the most efficient at high "
       "accuracy.",
       {"order", "cpu_time"},
       {"order_ode", "stages_slider_crank", "stages_hydraulic_arm", "stages_other"},
       highOrders},
      {"C2",
       "Up to about 10 stages speed the simulation up; then machine precision limits Newton.",
       {"cpu_time", "failure_newton"},
       {"stages_slider_crank", "stages_hydraulic_arm", "failure_round_off",
        "failure_round_off_modified"},
       manyStages},
      {"C3",
       "Error control by step doubling costs 50 % more and is very reliable.",
       {"estimate", "control", "steps"},
       {"estimate_ratio", "control_estimates", "steps_slider_crank"},
       stepDoubling},
      {"C4",
       "Below 200 unknowns residual and Jacobian cost more than the factorization, even a dense "
       "one.",
       {"phases"},
       {"phases_ancf_pendulum", "phases_beam_chain"},
       phaseShares},
      {"C5",
       "The derivatives of the mass matrix matter little in flexible multibody systems; dropping "
       "them is faster.",
       {"jacobian"},
       {"jacobian_slider_crank_flexible", "jacobian_slider_crank", "jacobian_ancf_pendulum"},
       massDerivatives},
      {"C6",
       "Index 3 directly: Newton converges badly below h = 1e-6 to 1e-8; index 2 cures it, and "
       "scaling by 1/h helps.",
       {"small_steps"},
       {"small_steps_error", "small_steps_newton", "failure_tiny_index3"},
       smallSteps},
      {"C7",
       "At high order the drift without GGL stabilisation is negligible.",
       {"drift"},
       {"drift_pendulum", "drift_cost"},
       driftIsNegligible},
      {"C8",
       "Multistep methods cannot restart quickly after a discontinuity.",
       {"peers"},
       {"peers_smooth", "peers_discontinuous", "peers_located", "discontinuity_ignore"},
       multistepRestart},
      {"C9",
       "High order pays in the smooth part; at discontinuities the step must be small.",
       {"cpu_time", "steps"},
       {"steps_slider_crank", "steps_hydraulic_arm", "stages_slider_crank"},
       smallStepsAtJumps},
      {"C10",
       "The 2-stage Lobatto IIIA scheme in K-form is Newmark's method with beta = 1/4, "
       "gamma = 1/2.",
       {},
       {},
       newmarkIsLobatto},
      {"C11",
       "The K-form needs no factorization of the mass matrix.",
       {"k_form"},
       {"k_form"},
       noMassFactorization},
      {"C12",
       "The rule of the modified Newton method (contractivity above 0.7 after 3 iterations; 25 "
       "iterations) is efficient.",
       {"newton_rule"},
       {"newton_rule"},
       newtonRule},
      {"C13",
       "Radau IIA is the best family for mechanical differential-algebraic systems.",
       {"families"},
       {"families"},
       radauIsBest},
      {"C14",
       "Relative tolerances help little for oscillatory solutions.",
       {"control"},
       {"control_norm"},
       relativeTolerances},
      {"C15",
       "Jacobian parts can be reused after a change of step; a factorization cannot be updated "
       "cheaply.",
       {"jacobian", "phases"},
       {"jacobian_reuse", "phases_ancf_pendulum"},
       jacobianReuse}};
  return all;
}

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

std::span<const Claim> claims() { return catalogue(); }

Finding judge(const Claim& claim, const ResultTables& tables) {
  try {
    return claim.evaluate(tables);
  } catch (const MissingResults& missing) {
    return {Verdict::kNotMeasurable, "–", missing.what()};
  } catch (const Misuse& old) {  // a table of another version
    return {Verdict::kNotMeasurable, "–", old.what()};
  }
}

std::string commandOf(const Claim& claim) {
  std::string command;
  for (const auto study : claim.studies) {
    command +=
        fmt::format("{}irk run {} && irk plot {}", command.empty() ? "" : " && ", study, study);
  }
  return command.empty() ? "irk claims" : command;
}

std::string claimsText(const ResultTables& tables) {
  std::string text;
  for (const auto& claim : claims()) {
    const Finding finding = judge(claim, tables);
    text +=
        fmt::format("{:<4}{}: {}\n    {}\n    {}\n    {}\n", claim.id, verdictText(finding.verdict),
                    finding.number, claim.statement, finding.reason, commandOf(claim));
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
        verdictClass(finding.verdict), claim.id, claim.id, escapeHtml(claim.statement),
        verdictText(finding.verdict), escapeHtml(finding.number), escapeHtml(finding.reason),
        escapeHtml(commandOf(claim)), linksHtml(claim, figures));
  }
  return html + "</tbody></table>\n";
}

}  // namespace irk::claims
