// Claims about Newton's method: its Jacobian, its rule, its parts' cost, tiny steps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "experiments/analyses/cost_at_error.h"
#include "experiments/claims/evaluations.h"
#include "experiments/claims/measures.h"

namespace irk::claims {
namespace {

double iterationsPerStep(const Table& runs) {
  std::vector<double> ratios;
  for (const auto& row : runs.rows) {
    const double steps = numberAt(runs, row, "steps_accepted");
    if (steps > 0) ratios.push_back(numberAt(runs, row, "newton_iterations") / steps);
  }
  return median(ratios);
}

double failedPart(const Table& runs) {
  std::vector<double> failed;
  for (const auto& row : runs.rows) failed.push_back(succeededAt(runs, row) ? 0 : 1);
  return part(failed, [](double x) { return x > 0; });
}

// How a table writes a number; empty where it does not have it.
std::string cellOf(const Table& table, std::string_view column, double number) {
  for (const auto& cell : distinct(table, column)) {
    if (std::stod(cell) == number) return cell;
  }
  return {};
}

int countedTwice(const CostRatios& ratios) {
  return static_cast<int>(std::count_if(ratios.all.begin(), ratios.all.end(), [](double x) { return x != 1; }));
}

// Of all triples of the rule: cost over the cheapest triple's, per scene, method and error.
std::map<TableRow, std::vector<double>> costsOfRules(const Table& runs) {
  const std::string_view rule[] = {"contractivity_limit", "contractivity_after", "max_iterations"};
  std::map<TableRow, std::map<TableRow, double>> costs;  // case -> rule -> cost
  for (const auto& series : seriesOf(runs)) {
    TableRow numbers;
    for (const auto column : rule) numbers.push_back(textAt(runs, *series.rows.front(), column));
    for (const double error : comparedErrors()) {
      const TableRow where{textAt(runs, *series.rows.front(), "scene"), textAt(runs, *series.rows.front(), "settings"),
                           textAt(runs, *series.rows.front(), "method"), fmt::format("{}", error)};
      const double cost = seriesCostAtError(runs, series, "cpu_s", error);
      if (!std::isnan(cost)) costs[where][numbers] = cost;
    }
  }
  std::map<TableRow, std::vector<double>> excess;
  for (const auto& [where, rules] : costs) {
    double least = kInfinity;
    for (const auto& [numbers, cost] : rules) least = std::min(least, cost);
    for (const auto& [numbers, cost] : rules) excess[numbers].push_back(cost / least);
  }
  return excess;
}

// Time of a decoupled factorization over that of the coupled one.
std::vector<double> decoupledFactorizations(const Table& phases) {
  constexpr double kUnknowns = 20;
  std::map<TableRow, double> coupled;
  std::vector<double> ratios;
  for (const std::string_view solver : {"coupled_dense", "schur"}) {
    for (const auto& row : phases.rows) {
      if (textAt(phases, row, "solver") != solver || numberAt(phases, row, "n") < kUnknowns) {
        continue;
      }
      TableRow key;
      for (const auto* column : {"scene", "settings", "method", "derivatives"}) {
        key.push_back(textAt(phases, row, column));
      }
      const double seconds = numberAt(phases, row, "factorization_s");
      if (solver == "coupled_dense") {
        coupled[key] = seconds;
      } else if (coupled.contains(key)) {
        ratios.push_back(seconds / coupled[key]);
      }
    }
  }
  return ratios;
}

}  // namespace

Finding phaseShares(const ResultTables& tables) {
  constexpr double kFew = 200, kNearlyAll = 0.95, kHalf = 0.5;
  const Table phases = where(tables.table("phases", "phases"), {{"solver", "coupled_dense"}});
  std::vector<double> shares;
  double crossing = kInfinity;  // the fewest unknowns with a dearer factorization
  for (const auto& row : phases.rows) {
    const double n = numberAt(phases, row, "n");
    if (n >= kFew) continue;
    const double evaluation = numberAt(phases, row, "share_residual") + numberAt(phases, row, "share_jacobian");
    const double factorization = numberAt(phases, row, "share_factorization");
    shares.push_back(evaluation / (evaluation + factorization));
    if (factorization > evaluation) crossing = std::min(crossing, n);
  }
  if (shares.empty()) return notMeasurable("no run with the coupled dense solver succeeded");
  const double dearer = part(shares, [](double x) { return x > 0.5; });
  return {graded(1 - dearer, 1 - kNearlyAll, 1 - kHalf),
          fmt::format("evaluations dearer in {} of the runs", percent(dearer)),
          fmt::format("Residual and Jacobian against the factorization of the coupled dense matrix "
                      "of all stages, {} runs with fewer than {:g} unknowns "
                      "(confirmed: {}). {}",
                      shares.size(), kFew, percent(kNearlyAll),
                      std::isinf(crossing) ? "The factorization is never dearer."
                                           : fmt::format("The factorization is dearer from n = {:g} on.", crossing))};
}

Finding massDerivatives(const ResultTables& tables) {
  constexpr double kSame = 1.1, kLittle = 1.5;
  const Table& all = tables.runs("jacobian");
  const Table rod = where(inBlocks(all, "jacobian", {"terms_elastic_rod"}), {{"newton", "simplified"}});
  const auto flexible = [&](std::string_view cost) { return compareCosts(rod, "jacobian", "full", "no_mass", cost); };
  const CostRatios iterations = flexible("newton_iterations"), time = flexible("cpu_s");
  if (iterations.all.empty()) return notMeasurable("no error is reached with and without them");
  const auto control = compareCosts(inBlocks(all, "jacobian", {"terms_constant_mass"}), "jacobian", "full", "no_mass",
                                    "newton_iterations");
  const double more = median(iterations.all), slower = median(time.all);
  Finding finding{
      graded(more, kSame, kLittle), fmt::format("{:.3g} times the iterations, {:.3g} times the time", more, slower),
      fmt::format("Elastic slider-crank at equal errors, medians of {} pairs; little: at "
                  "most {} times the iterations, and not slower. {} errors are no longer "
                  "reached. With constant mass (ANCF pendulum) {} of {} counts change.",
                  iterations.all.size(), kSame, iterations.lost, countedTwice(control), control.all.size())};
  const bool faster = slower <= 1 && iterations.lost == 0;
  if (finding.verdict == Verdict::kConfirmed && !faster) finding.verdict = Verdict::kWithinLimits;
  return finding;
}

Finding smallSteps(const ResultTables& tables) {
  constexpr double kTiny = 1.1e-7, kUseless = 1e-3, kFine = 1e-6, kHelps = 0.9;
  const Table runs = inBlocks(tables.runs("small_steps"), "small_steps", {"known_multiplier"});
  const auto tiny = [&](std::string_view formulation, std::string_view scaling) {
    const Table chosen = where(runs, {{"formulation", formulation}, {"scaling", scaling}});
    return where(chosen, [&](auto& row) { return numberAt(chosen, row, "h") <= kTiny; });
  };
  const Table index3 = tiny("index3", "on"), raw3 = tiny("index3", "off");
  const Table index2 = tiny("index2", "on");
  if (index3.rows.empty() || index2.rows.empty()) return notMeasurable("no run with h <= 1e-7");
  const double error3 = median(numbersOf(index3, "error_z"));
  const double error2 = median(numbersOf(index2, "error_z"));
  const bool bad = failedPart(raw3) > 0.5 || !(error3 < kUseless);
  const bool cured = failedPart(index2) == 0 && error2 <= kFine;
  const bool helps =
      failedPart(index3) < failedPart(raw3) || iterationsPerStep(index3) < kHelps * iterationsPerStep(raw3);
  Finding finding{
      Verdict::kContradicted, fmt::format("multiplier's error {:.1g} (index 3), {:.1g} (index 2)", error3, error2),
      fmt::format("Pendulum at h <= 1e-7, medians; useless from {:g} on, fine below {:g}. Failed runs: "
                  "index 3 unscaled {}, scaled {}, index 2 {}. Newton iterations per step: {:.3g}, "
                  "{:.3g}, {:.3g}.",
                  kUseless, kFine, percent(failedPart(raw3)), percent(failedPart(index3)), percent(failedPart(index2)),
                  iterationsPerStep(raw3), iterationsPerStep(index3), iterationsPerStep(index2))};
  if (bad && cured) finding.verdict = helps ? Verdict::kConfirmed : Verdict::kWithinLimits;
  return finding;
}

Finding noMassFactorization(const ResultTables& tables) {
  constexpr double kNotDearer = 1.0, kSlightly = 1.2;
  constexpr std::string_view kCount = "mass factorizations: ";
  const Table& runs = tables.runs("k_form");
  const auto time = compareCosts(runs, "formulation", "first_order", "index2", "cpu_s");
  const auto residuals = compareCosts(runs, "formulation", "first_order", "index2", "residuals");
  if (time.all.empty()) return notMeasurable("no error is reached in both forms");
  std::vector<double> factorizations;  // per step
  for (const auto& row : runs.rows) {
    const std::string& detail = textAt(runs, row, "detail");
    if (!succeededAt(runs, row) || !detail.starts_with(kCount)) continue;
    factorizations.push_back(std::stod(detail.substr(kCount.size())) / numberAt(runs, row, "steps_accepted"));
  }
  return {graded(median(time.all), kNotDearer, kSlightly),
          fmt::format("{:.3g} times the time of v' = M^-1 F", median(time.all)),
          fmt::format("K-form over first-order form at equal errors, median of {} pairs. It needs "
                      "{:.3g} times the residuals and never factorizes M alone; the other does so up to "
                      "{:.3g} times per step (once where M is constant). Confirmed: not slower.",
                      time.all.size(), median(residuals.all),
                      factorizations.empty() ? 0 : *std::max_element(factorizations.begin(), factorizations.end()))};
}

Finding newtonRule(const ResultTables& tables) {
  constexpr double kGood = 1.1, kFair = 1.3;
  const auto excess = costsOfRules(tables.runs("newton_rule"));
  const auto number = [](const std::string& cell) { return std::stod(cell); };
  double papers = std::numeric_limits<double>::quiet_NaN(), best = kInfinity, worst = 0;
  TableRow best_rule;
  for (const auto& [rule, ratios] : excess) {
    const double typical = median(ratios);
    const bool paper = number(rule[0]) == 0.7 && number(rule[1]) == 3 && number(rule[2]) == 25;
    if (paper) papers = typical;
    worst = std::max(worst, typical);
    if (typical < best) {
      best = typical;
      best_rule = rule;
    }
  }
  if (std::isnan(papers)) return notMeasurable("no run with 0.7, 3 and 25 reached an error");
  return {graded(papers / best, kGood, kFair), fmt::format("{:.3g} times the cost of the best rule", papers / best),
          fmt::format("CPU time at equal errors, medians over scenes, methods and errors; {} rules "
                      "tried, the best is contractivity {} after {} of {} iterations, the worst "
                      "costs {:.3g} times as much. Confirmed: at most {}.",
                      excess.size(), number(best_rule[0]), best_rule[1], best_rule[2], worst / best, kGood)};
}

Finding jacobianReuse(const ResultTables& tables) {
  constexpr double kSameTime = 1.05, kFew = 0.05, kCheap = 1.0 / 3;
  constexpr double kNever = 0, kContracting = 0.1;
  const Table reuse = inBlocks(tables.runs("jacobian"), "jacobian", {"reuse"});
  const std::string never = cellOf(reuse, "keep_jacobian_below", kNever);
  const std::string kept = cellOf(reuse, "keep_jacobian_below", kContracting);
  const auto ratio = [&](std::string_view cost) {
    return compareCosts(reuse, "keep_jacobian_below", never, kept, cost);
  };
  const CostRatios time = ratio("cpu_s"), jacobians = ratio("jacobians");
  if (time.all.empty()) return notMeasurable("no error is reached with and without reuse");
  const auto decoupled = decoupledFactorizations(tables.table("phases", "phases"));
  const auto count = static_cast<double>(time.all.size());
  const bool reused = median(time.all) <= kSameTime && time.lost <= time.won + kFew * count;
  const bool cheap = median(decoupled) <= kCheap;
  Finding finding{Verdict::kContradicted,
                  fmt::format("{:.2g} times the Jacobians; factorization {:.2g} times the coupled one's time",
                              median(jacobians.all), median(decoupled)),
                  fmt::format("Kept while Newton contracts by 10 or more, against never: {:.3g} times the CPU time at "
                              "equal errors, {} errors lost and {} won of {} (reusable: at most {} times, at most {} "
                              "lost "
                              "beyond those won). A new step size needs a new factorization; decoupled by a Schur form "
                              "of A it "
                              "takes {:.2g} of the coupled one's "
                              "time (median of {} cases with 20 and more unknowns){}",
                              median(time.all), time.lost, time.won, time.all.size(), kSameTime, percent(kFew),
                              median(decoupled), decoupled.size(),
                              cheap ? ", below a third: the second half holds for the coupled matrix only." : ".")};
  if (reused) finding.verdict = cheap ? Verdict::kWithinLimits : Verdict::kConfirmed;
  return finding;
}

}  // namespace irk::claims
