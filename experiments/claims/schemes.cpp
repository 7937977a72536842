// Claims about the schemes: order, stages, families, drift.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/analyses/newmark.h"
#include "experiments/claims/evaluations.h"
#include "experiments/claims/measures.h"

namespace irk::claims {
namespace {

// The smooth blocks of the study cpu_time, one scene each.
constexpr std::string_view kSmoothCases[] = {"crank", "arm_smooth", "elastic_pendulum"};

// The smallest error that any method reaches, among those asked for.
Table atSmallestError(const Table& costs) {
  const auto reached = where(costs, {{"reached", "1"}});
  const auto errors = numbersOf(reached, "target_error");
  if (errors.empty()) return {costs.head, costs.columns, {}};
  const double least = *std::min_element(errors.begin(), errors.end());
  return where(reached, [&](const TableRow& row) { return numberAt(reached, row, "target_error") == least; });
}

double classicalOrder(const Table& table, const TableRow& row) {
  const double s = numberAt(table, row, "stages");
  return textAt(table, row, "family") == "gauss" ? 2 * s : 2 * s - 1;
}

double cheapestOrder(const Table& table) {
  const auto best = std::min_element(table.rows.begin(), table.rows.end(), [&](auto& a, auto& b) {
    return numberAt(table, a, "cpu_s") < numberAt(table, b, "cpu_s");
  });
  return classicalOrder(table, *best);
}

double highestMeasuredOrder(const Table& orders) {
  double highest = 0;
  for (const auto& row : orders.rows) {
    if (textAt(orders, row, "family") == "gauss" && textAt(orders, row, "verdict") == "agrees") {
      highest = std::max(highest, numberAt(orders, row, "order"));
    }
  }
  return highest;
}

}  // namespace

Finding highOrders(const ResultTables& tables) {
  constexpr double kWanted = 19.8, kHigh = 18, kNear = 1.1, kStillHigh = 9;
  const double reached = highestMeasuredOrder(tables.table("order", "orders"));
  const Table& costs = tables.table("cpu_time", "cpu_at_error");
  int cases = 0, efficient = 0, fairly = 0;
  std::string cheapest;
  for (const auto& one : kSmoothCases) {
    const Table best = atSmallestError(inBlocks(costs, "cpu_time", {one}));
    if (best.rows.empty()) continue;
    ++cases;
    const double all = leastCost(best, [](auto&) { return true; });
    const double high = leastCost(best, [&](auto& row) { return classicalOrder(best, row) >= kHigh; });
    efficient += high <= kNear * all ? 1 : 0;
    fairly += cheapestOrder(best) >= kStillHigh ? 1 : 0;
    cheapest += fmt::format("{}{:g}", cheapest.empty() ? "" : ", ", cheapestOrder(best));
  }
  if (cases == 0) return notMeasurable("no smooth scene reaches any of the errors asked for");
  Finding finding{Verdict::kContradicted, fmt::format("order {:.2f} observed; cheapest orders {}", reached, cheapest),
                  fmt::format("In multiprecision Gauss schemes show orders up to {:.1f}. At the smallest "
                              "error reached, order {} or more is within 10 % of the cheapest on "
                              "{} of {} smooth scenes, and the cheapest has order {} or more on {}.",
                              reached, kHigh, efficient, cases, kStillHigh, fairly)};
  if (reached >= kWanted && 2 * fairly >= cases) finding.verdict = Verdict::kWithinLimits;
  if (reached >= kWanted && 2 * efficient >= cases) finding.verdict = Verdict::kConfirmed;
  return finding;
}

Finding manyStages(const ResultTables& tables) {
  constexpr double kMin = 7, kMax = 13, kFair = 4, kManyStages = 10;
  const Table& costs = tables.table("cpu_time", "cpu_at_error");
  std::vector<double> fastest;
  for (const auto& one : kSmoothCases) {
    const Table best = atSmallestError(where(inBlocks(costs, "cpu_time", {one}), {{"family", "radau_iia"}}));
    if (!best.rows.empty()) fastest.push_back((cheapestOrder(best) + 1) / 2);
  }
  if (fastest.empty()) return notMeasurable("no smooth scene reaches any of the errors asked for");
  const Table runs = inBlocks(tables.runs("failure_newton"), "failure_newton", {"tight_tolerances"});
  std::vector<double> few, many;  // 1: failed
  for (const auto& row : runs.rows) {
    if (numberAt(runs, row, "rtol") > 1e-11) continue;
    const bool more = numberAt(runs, row, "stages") > kManyStages;
    (more ? many : few).push_back(succeededAt(runs, row) ? 0 : 1);
  }
  const auto failed = [](double x) { return x > 0; };
  const double best = median(fastest), few_fail = part(few, failed), many_fail = part(many, failed);
  Finding finding{Verdict::kContradicted, fmt::format("fastest with {:g} stages", best),
                  fmt::format("Radau IIA at the smallest error reached, median over {} smooth scenes; about 10 "
                              "means {} to {}. At tolerances of 1e-11 and below {} of the runs with more than "
                              "10 stages fail, {} of those with up to 10.",
                              fastest.size(), kMin, kMax, percent(many_fail), percent(few_fail))};
  const bool limited = many_fail > few_fail;
  if (best >= kFair && best <= kMax) finding.verdict = Verdict::kWithinLimits;
  if (best >= kMin && best <= kMax && limited) finding.verdict = Verdict::kConfirmed;
  return finding;
}

Finding driftIsNegligible(const ResultTables& tables) {
  constexpr double kHighOrder = 5, kNearlyAll = 0.95, kMost = 0.75;
  const Table runs =
      where(tables.runs("drift"), {{"formulation", "index2"}, {"family", "radau_iia"}, {"outcome", "success"}});
  std::vector<double> low, high;  // drift in units of the tolerance
  for (const auto& row : runs.rows) {
    const double ratio = numberAt(runs, row, "drift") / numberAt(runs, row, "rtol");
    if (std::isnan(ratio)) continue;
    (classicalOrder(runs, row) >= kHighOrder ? high : low).push_back(ratio);
  }
  if (high.empty()) return notMeasurable("no run of order 5 or more in index 2 succeeded");
  const double below = part(high, [](double x) { return x <= 1; });
  const auto ggl = compareCosts(tables.runs("drift"), "formulation", "index2", "ggl", "cpu_s");
  return {graded(1 - below, 1 - kNearlyAll, 1 - kMost),
          fmt::format("drift {:.2g} of the tolerance (median)", median(high)),
          fmt::format("Radau IIA of order 5 and more in index 2: the drift stays below the "
                      "tolerance in {} of {} runs (negligible: {}); of lower order it is {:.2g} of "
                      "it. GGL costs {:.2g} times the CPU time at the same error.",
                      percent(below), high.size(), percent(kNearlyAll), median(low), median(ggl.all))};
}

Finding newmarkIsLobatto(const ResultTables&) {
  constexpr double kRoundOff = 1000;
  const double difference = newmarkDifference();
  return {graded(difference, kRoundOff, kRoundOff), fmt::format("{:.2g} units of round-off", difference),
          fmt::format("Largest difference to Newmark's formulas over 100 steps of a nonlinear "
                      "oscillator; equal means below {:g} units.",
                      kRoundOff)};
}

Finding radauIsBest(const ResultTables& tables) {
  constexpr double kNear = 1.1, kMostly = 0.8, kHalf = 0.5;
  const Table& costs = tables.table("families", "cpu_at_error");
  int cases = 0, best = 0;
  std::vector<double> excess;
  for (const auto& scene : distinct(costs, "scene")) {
    for (const auto& error : distinct(costs, "target_error")) {
      const Table at = where(costs, {{"scene", scene}, {"target_error", error}, {"reached", "1"}});
      if (distinct(at, "family").size() < 2) continue;
      const double radau = leastCost(at, [&](auto& row) { return textAt(at, row, "family") == "radau_iia"; });
      const double other = leastCost(at, [&](auto& row) { return textAt(at, row, "family") != "radau_iia"; });
      ++cases;
      best += radau <= kNear * other ? 1 : 0;
      excess.push_back(radau / other);
    }
  }
  if (cases == 0) return notMeasurable("no error is reached by two families");
  const double share = static_cast<double>(best) / cases;
  return {graded(1 - share, 1 - kMostly, 1 - kHalf), fmt::format("best in {} of {} cases", best, cases),
          fmt::format("A case is a scene and an error; best: at most 10 % above the cheapest other "
                      "family, each with its best number of stages (confirmed: {}). CPU time over "
                      "that of the best other family: {:.2g} in the median.",
                      percent(kMostly), median(excess))};
}

}  // namespace irk::claims
