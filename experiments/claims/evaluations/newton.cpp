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

// --- C6

// One value per scene, method, formulation and scaling; the step of 1e-8 and that of 1e-4 are two blocks.
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

// The rule with the least median of its costs over those of the paper's rule.
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

}  // namespace

Measurement massDerivativesIterations(const ResultTables& tables, Setting setting) {
  const CostRatios ratios = withoutMassDerivatives(tables, setting, "newton_iterations");
  const bool some = ratios.lost + ratios.won > 0;
  return {ratios.cases,
          {},
          some ? fmt::format("{} errors are no longer reached, {} only now.", ratios.lost, ratios.won) : ""};
}

Measurement massDerivativesTime(const ResultTables& tables, Setting setting) {
  const CostRatios ratios = withoutMassDerivatives(tables, setting, "cpu_s");
  return {{},
          "no strategy leaves the evaluations of the dropped terms out: no_mass differentiates the whole residual at a "
          "= 0",
          ratios.cases.empty() ? ""
                               : fmt::format("With no_mass: {:.3g} times the CPU time, median of {} cases.",
                                             median(valuesOf(ratios.cases)), ratios.cases.size())};
}

Measurement iterationsAtSmallSteps(const ResultTables&, Setting) {
  return cannotMeasure(
      "no strategy has the paper's stopping rule alone: newton 'modified' also ends at stagnation and at round-off");
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

Measurement jacobianReuse(const ResultTables&, Setting) {
  return cannotMeasure(
      "no strategy of Newton's method keeps a Jacobian only across changes of the step size; study jacobian lacks such "
      "runs");
}

}  // namespace irk::claims
