#include "experiments/report/answers/study_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/base/median.h"
#include "experiments/claims/claim.h"
#include "experiments/report/answers/answer.h"
#include "experiments/report/answers/failures.h"
#include "experiments/report/answers/measured_answers.h"
#include "experiments/report/answers/order_answer.h"
#include "experiments/report/answers/solvers.h"
#include "experiments/report/ratios_html.h"
#include "experiments/runs/run_table.h"

namespace irk::report {
namespace {

// A study that compares the values of one column, each with its best method.
struct Comparison {
  const char *study, *column, *noun;
};
constexpr Comparison kComparisons[] = {{"work_precision", "integrator", ""},
                                       {"peers", "integrator", ""},
                                       {"beam", "integrator", ""},
                                       {"heat", "integrator", ""},
                                       {"families", "family", "the family "},
                                       {"cpu_time", "stages", "the number of stages "},
                                       {"discontinuity", "discontinuity", "the treatment "},
                                       {"drift", "formulation", "the formulation "},
                                       {"k_form", "formulation", "the formulation "}};
constexpr double kError = 1e-6;

// The study's target nearest to kError, on a logarithmic scale; 0 without targets.
double targetOf(const Table& costs) {
  std::set<double> targets;
  for (const auto& row : costs.rows) targets.insert(numberAt(costs, row, "target_error"));
  const auto distance = [](double x) { return std::abs(std::log10(x / kError)); };
  const auto nearest =
      std::min_element(targets.begin(), targets.end(), [&](double a, double b) { return distance(a) < distance(b); });
  return nearest == targets.end() ? 0 : *nearest;
}

std::string sentenceOf(const Comparison& comparison_of, const Table& costs) {
  const double target = targetOf(costs);
  if (target <= 0) return {};
  const SolverCosts found = costsOf(
      costs, comparison_of.column, [&](const TableRow& row) { return numberAt(costs, row, "target_error") == target; });
  const auto ranked = ranking(found);
  if (ranked.size() < 2) return {};
  const int problems = solvable(found);
  const Ranked &best = ranked[0], &next = ranked[1];
  const auto won = wins(found);
  const auto at = won.find(best.solver);
  return fmt::format(
      "At an error of {}, {}`{}` is the cheapest: it reaches the error in {} of {} problems, is the fastest in {}, "
      "and {}.",
      errorText(target), comparison_of.noun, best.solver, best.solved, problems, at == won.end() ? 0 : at->second,
      comparison(ratio(found, next.solver, best.solver), best, next, problems));
}

// The violation of the position constraint by formulation, from the runs that succeed with every formulation.
std::string driftSentence(const Table& runs) {
  std::set<std::string> formulations;
  std::map<TableRow, std::map<std::string, double>> drifts;  // by scene, settings, method, tolerance and end
  for (const auto& row : runs.rows) {
    const double drift = numberAt(runs, row, "drift");
    const auto& formulation = textAt(runs, row, "formulation");
    if (!succeededAt(runs, row) || std::isnan(drift)) continue;
    formulations.insert(formulation);
    TableRow place;
    for (const auto* column : {"scene", "settings", "method", "configuration", "rtol", "atol", "h", "t_end"}) {
      if (runs.hasColumn(column)) place.push_back(textAt(runs, row, column));
    }
    drifts[place][formulation] = drift;
  }
  std::map<std::string, std::vector<double>> common;
  for (const auto& [place, by_formulation] : drifts) {
    if (by_formulation.size() < formulations.size()) continue;
    for (const auto& [formulation, drift] : by_formulation) common[formulation].push_back(drift);
  }
  if (common.empty()) return {};
  std::vector<std::string> parts;
  for (const auto& [formulation, values] : common) {
    parts.push_back(fmt::format("{:.0e} with `{}`", median(values), formulation));
  }
  const std::size_t runs_each = common.begin()->second.size();
  return fmt::format("The median drift of the {} runs that succeed with every formulation: {}.", runs_each,
                     listText(parts));
}

// Which solver is the fastest on which scene, where these are few.
std::string fastestSentence(const Table& costs, const Comparison& comparison_of, double target) {
  constexpr std::size_t kMostScenes = 5;
  std::map<std::string, std::map<std::string, double>> best;  // scene -> value -> cost
  for (const auto& row : costs.rows) {
    const double cost = numberAt(costs, row, "cpu_s");
    if (numberAt(costs, row, "target_error") != target || std::isnan(cost)) continue;
    const auto [at, added] =
        best[textAt(costs, row, "scene")].try_emplace(textAt(costs, row, comparison_of.column), cost);
    if (!added) at->second = std::min(at->second, cost);
  }
  if (best.size() < 2 || best.size() > kMostScenes) return {};
  std::vector<std::string> parts;
  for (const auto& [scene, by_value] : best) {
    const auto least = std::ranges::min_element(by_value, {}, [](const auto& one) { return one.second; });
    parts.push_back(fmt::format("`{}` on {}", least->first, scene));
  }
  return fmt::format("The fastest there by scene: {}.", listText(parts));
}

// The claims that are judged by runs of this study.
std::string claimsSentence(std::string_view study) {
  std::vector<std::string> ids;
  for (const auto& claim : claims::protocol().claims) {
    if (std::ranges::find(claim.studies, study) != claim.studies.end()) ids.push_back(claim.id);
  }
  if (ids.empty()) return {};
  return fmt::format("Its runs judge the claim{} {} of the paper.", ids.size() > 1 ? "s" : "", listText(ids));
}

// How the runs of each solver end over all scenes and tolerances.
std::string robustnessSentence(const Table& counts) {
  std::vector<std::string> parts;
  for (const auto& row : counts.rows) {
    if (textAt(counts, row, "collection") != "all" || textAt(counts, row, "tolerance") != "all") continue;
    const double runs = numberAt(counts, row, "runs");
    parts.push_back(fmt::format("`{}` {:.0f} % ({})", textAt(counts, row, "integrator"),
                                100 * numberAt(counts, row, "right") / runs, textAt(counts, row, "wrong")));
  }
  if (parts.empty()) return {};
  return fmt::format(
      "Of the runs that a solver can be asked for, these shares are right (in brackets the number of "
      "wrong successes): {}.",
      listText(parts));
}

// nullptr without the table.
const Table* tableIfAny(const claims::ResultTables& tables, std::string_view study, std::string_view name) {
  try {
    return &tables.table(study, name);
  } catch (const claims::MissingResults&) {
    return nullptr;
  }
}

}  // namespace

std::vector<std::string> studyAnswers(std::string_view study, const claims::ResultTables& tables) {
  std::vector<std::string> sentences;
  for (const auto& comparison_of : kComparisons) {
    const Table* costs = comparison_of.study == study ? tableIfAny(tables, study, "cpu_at_error") : nullptr;
    if (!costs) continue;
    sentences.push_back(sentenceOf(comparison_of, *costs));
    sentences.push_back(fastestSentence(*costs, comparison_of, targetOf(*costs)));
  }
  if (const Table* counts = tableIfAny(tables, study, "robustness")) sentences.push_back(robustnessSentence(*counts));
  if (const Table* orders = tableIfAny(tables, study, "orders")) sentences.push_back(sentenceOf(checkOf(*orders)));
  if (study == "audit") sentences.push_back(wrongSentence(tables));
  if (const Table* ratios = tableIfAny(tables, study, "ratios")) sentences.push_back(ratiosSentence(*ratios));
  if (const Table* estimates = tableIfAny(tables, study, "estimates")) {
    sentences.push_back(estimateSentence(*estimates));
  }
  if (const Table* phases = tableIfAny(tables, study, "phases")) sentences.push_back(phasesSentence(*phases));
  if (const Table* energy = tableIfAny(tables, study, "energy")) sentences.push_back(energySentence(*energy));
  if (const Table* slopes = tableIfAny(tables, study, "scaling_slopes")) sentences.push_back(scalingSentence(*slopes));
  if (const Table* runs = tableIfAny(tables, study, "runs")) {
    if (study == "drift") sentences.push_back(driftSentence(*runs));
    if (study == "steps") sentences.push_back(stepsSentence(*runs));
    if (study == "small_steps") sentences.push_back(smallStepsSentence(*runs));
    if (study.starts_with("failure_")) sentences.push_back(familiesFailSentence(*runs));
    sentences.push_back(outcomeSentence(*runs));
    sentences.push_back(claimsSentence(study));
  }
  std::erase(sentences, "");
  return sentences;
}

}  // namespace irk::report
