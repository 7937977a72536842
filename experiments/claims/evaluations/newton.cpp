// Claims about Newton's method: its Jacobian, its rule, tiny steps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/claims/evaluations.h"
#include "experiments/claims/measures.h"

namespace irk::claims {
namespace {

std::vector<double> valuesOf(const std::vector<Case>& cases) {
  std::vector<double> values;
  for (const auto& one : cases) values.push_back(one.value);
  return values;
}

CostRatios withoutMassDerivatives(const ResultTables& tables, Setting setting, std::string_view cost) {
  return compareCosts(timedClaimRuns(tables, "mass_terms", setting), "jacobian", "full", "no_mass", cost);
}

Measurement ofCosts(const CostRatios& ratios) {
  const bool some = ratios.lost + ratios.won > 0;
  return {ratios.cases,
          {},
          some ? fmt::format("{} errors are no longer reached, {} only now.", ratios.lost, ratios.won) : ""};
}

// --- C6

// Newton iterations per step at tiny steps, divided by those at the usual step, per scene, method, scaling and
// tolerance of the residual. A run that fails at the tiny step only counts as infinitely many iterations; one that
// fails at the usual step as well is no case.
Measurement moreIterations(const ResultTables& tables, Setting setting, const Cells& cells) {
  const auto placeOf = [](const Table& runs, const TableRow& run) {
    return TableRow{textAt(runs, run, "scene"), textAt(runs, run, "method"), textAt(runs, run, "scaling"),
                    textAt(runs, run, "residual_tolerance")};
  };
  const auto perStep = [](const Table& runs, const TableRow& run) {
    if (!succeededAt(runs, run)) return kInfinity;
    return numberAt(runs, run, "newton_iterations") / numberAt(runs, run, "steps_accepted");
  };
  const Table usual = where(claimRuns(tables, "rule_usual", setting), cells);
  const Table tiny = where(claimRuns(tables, "rule_tiny", setting), cells);
  std::map<TableRow, double> at_usual;
  for (const auto& run : usual.rows) at_usual[placeOf(usual, run)] = perStep(usual, run);
  Measurement measured;
  std::size_t failed = 0;
  for (const auto& run : tiny.rows) {
    const TableRow place = placeOf(tiny, run);
    const auto at = at_usual.find(place);
    if (at == at_usual.end() || std::isinf(at->second)) continue;
    // A step that starts below the tolerance has no iteration.
    const double ratio = perStep(tiny, run) / std::max(at->second, 1.0);
    if (std::isinf(ratio)) ++failed;
    measured.cases.push_back({place.front(), ratio});
  }
  measured.remark = fmt::format("{} of {} runs fail at the tiny step only.", failed, measured.cases.size());
  return measured;
}

// One value per scene, method, formulation and scaling. The steps 1e-8 and 1e-4 are in two blocks.
std::map<TableRow, double> multiplierErrors(const ResultTables& tables, std::string_view block, Setting setting,
                                            const Cells& cells) {
  const Table runs = where(timedClaimRuns(tables, block, setting), cells);
  std::map<TableRow, double> errors;
  for (const auto& run : runs.rows) {
    if (!succeededAt(runs, run)) continue;
    errors[{textAt(runs, run, "scene"), textAt(runs, run, "method"), textAt(runs, run, "scaling")}] =
        numberAt(runs, run, "error_z");
  }
  return errors;
}

Measurement digitsLost(const ResultTables& tables, Setting setting, const Cells& cells) {
  const auto usual = multiplierErrors(tables, "usual_steps", setting, cells);
  const auto tiny = multiplierErrors(tables, "tiny_steps", setting, cells);
  Measurement measured;
  int failed = 0;
  for (const auto& [place, error] : usual) {
    const auto at = tiny.find(place);
    if (at == tiny.end()) {
      ++failed;
      continue;
    }
    // An error of zero is one round-off unit.
    const auto atLeastRoundOff = [](double x) { return x == 0 ? std::numeric_limits<double>::epsilon() : x; };
    measured.cases.push_back({place.front(), std::log10(atLeastRoundOff(at->second) / atLeastRoundOff(error))});
  }
  if (failed > 0) measured.remark = fmt::format("{} runs fail at the tiny step only.", failed);
  return measured;
}

// --- C12

using Rule = TableRow;
using RuleCosts = std::map<Rule, double>;

struct RuleCase {
  std::string scene;
  RuleCosts costs;
};

Rule ruleOf(const Table& runs, const TableRow& run) {
  return {textAt(runs, run, "contractivity_limit"), textAt(runs, run, "contractivity_after"),
          textAt(runs, run, "max_iterations")};
}

bool isPapers(const Rule& rule) {
  return std::stod(rule[0]) == 0.7 && std::stod(rule[1]) == 3 && std::stod(rule[2]) == 25;
}

// The costs of all rules, per scene, method and error.
std::vector<RuleCase> ruleCases(const Table& runs) {
  std::map<TableRow, RuleCase> cases;
  for (const auto& series : seriesOf(runs)) {
    const TableRow& run = *series.rows.front();
    for (const double error : comparedErrors()) {
      const double cost = seriesCost(runs, series, "cpu_s", "error", error);
      if (std::isnan(cost)) continue;
      RuleCase& one = cases[{textAt(runs, run, "scene"), textAt(runs, run, "settings"), textAt(runs, run, "method"),
                             fmt::format("{}", error)}];
      one.scene = textAt(runs, run, "scene");
      one.costs[ruleOf(runs, run)] = cost;
    }
  }
  std::vector<RuleCase> all;
  for (auto& [place, one] : cases) all.push_back(std::move(one));
  return all;
}

// The rule with the smallest median cost, relative to the costs of the paper's rule.
Rule bestRule(const std::vector<RuleCase>& cases, const std::set<std::string>& scenes, const Rule& papers) {
  std::map<Rule, std::vector<double>> ratios;
  for (const auto& one : cases) {
    const auto paper = one.costs.find(papers);
    if (!scenes.contains(one.scene) || paper == one.costs.end()) continue;
    for (const auto& [rule, cost] : one.costs) ratios[rule].push_back(cost / paper->second);
  }
  Rule best = papers;
  double least = 1;
  for (const auto& [rule, values] : ratios) {
    if (median(values) >= least) continue;
    least = median(values);
    best = rule;
  }
  return best;
}

Measurement massDerivativesIterations(const ResultTables& tables, Setting setting) {
  return ofCosts(withoutMassDerivatives(tables, setting, "newton_iterations"));
}

Measurement massDerivativesTime(const ResultTables& tables, Setting setting) {
  return ofCosts(withoutMassDerivatives(tables, setting, "cpu_s"));
}

Measurement iterationsAtSmallSteps(const ResultTables& tables, Setting setting) {
  Measurement measured = moreIterations(tables, setting, {{"formulation", "index3"}});
  Measurement index2 = moreIterations(tables, setting, {{"formulation", "index2"}, {"scaling", "on"}});
  std::erase_if(index2.cases, [](const Case& one) { return std::isnan(one.value); });
  if (!index2.cases.empty()) {
    const double times = median(valuesOf(index2.cases));
    measured.remark += fmt::format(" In index 2, scaled: {}{}",
                                   std::isinf(times) ? "" : fmt::format("median {:.3g} times, ", times), index2.remark);
  }
  return measured;
}

Measurement digitsLostIndex3(const ResultTables& tables, Setting setting) {
  return digitsLost(tables, setting, {{"formulation", "index3"}});
}

Measurement digitsLostIndex2(const ResultTables& tables, Setting setting) {
  return digitsLost(tables, setting, {{"formulation", "index2"}, {"scaling", "on"}});
}

Measurement newtonRule(const ResultTables& tables, Setting setting) {
  const Table runs = timedClaimRuns(tables, "newton_rule", setting);
  const auto cases = ruleCases(runs);
  Rule papers;
  std::set<std::string> halves[2];
  for (const auto& one : cases) {
    for (const auto& [rule, cost] : one.costs) papers = isPapers(rule) ? rule : papers;
  }
  if (papers.empty()) return cannotMeasure("no run with the paper's rule reaches an error");
  std::set<std::string> scenes;
  for (const auto& one : cases) scenes.insert(one.scene);
  std::size_t number = 0;  // every other scene of the sorted ones
  for (const auto& scene : scenes) halves[number++ % 2].insert(scene);
  Measurement measured;
  for (const int judged : {0, 1}) {
    const Rule best = bestRule(cases, halves[1 - judged], papers);
    measured.remark +=
        fmt::format("{}Best on {} scenes: contractivity {} after {}, {} iterations.",
                    measured.remark.empty() ? "" : " ", halves[1 - judged].size(), best[0], best[1], best[2]);
    for (const auto& one : cases) {
      const auto paper = one.costs.find(papers), other = one.costs.find(best);
      if (!halves[judged].contains(one.scene) || paper == one.costs.end() || other == one.costs.end()) continue;
      measured.cases.push_back({one.scene, paper->second / other->second});
    }
  }
  return measured;
}

Measurement jacobianReuse(const ResultTables& tables, Setting setting) {
  const Table runs = timedClaimRuns(tables, "step_reuse", setting);
  const bool paper = setting == Setting::kPaper;
  const std::string_view without = paper ? "modified_each_step" : "broyden_each_step";
  const std::string_view with = paper ? "modified_step_change" : "broyden_step_change";
  Measurement measured = ofCosts(compareCosts(runs, "newton", without, with, "cpu_s"));
  const CostRatios jacobians = compareCosts(runs, "newton", without, with, "jacobians");
  if (!jacobians.cases.empty()) {
    measured.remark += fmt::format("{}Jacobians: {:.3g} times, median.", measured.remark.empty() ? "" : " ",
                                   median(valuesOf(jacobians.cases)));
  }
  return measured;
}

}  // namespace

Evaluations newtonEvaluations() {
  return {
      {"C5a", massDerivativesIterations},
      {"C5b", massDerivativesTime},
      {"C6a", iterationsAtSmallSteps},
      {"C6b", digitsLostIndex3},
      {"C6c", digitsLostIndex2},
      {"C12", newtonRule},
      {"C15a", jacobianReuse},
  };
}

}  // namespace irk::claims
