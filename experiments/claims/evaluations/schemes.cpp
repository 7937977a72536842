// Claims about the schemes: order, stages, families, drift.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/analyses/newmark.h"
#include "experiments/claims/evaluations.h"
#include "experiments/claims/measures.h"

namespace irk::claims {
namespace {

double stagesAt(const Table& runs, const TableRow& run) { return numberAt(runs, run, "stages"); }

double classicalOrder(const Table& runs, const TableRow& run) {
  const double s = stagesAt(runs, run);
  return textAt(runs, run, "family") == "gauss" ? 2 * s : 2 * s - 1;
}

// --- C2b

// What ends the gain from lower tolerances; unknown if runs still improve at the lowest one.
enum class Limit { kUnknown, kNewton, kOther };

// Steps rejected by Newton's method, or begun again by it, per accepted step.
double newtonTrouble(const Table& runs, const TableRow& run) {
  const double steps = std::max(numberAt(runs, run, "steps_accepted"), 1.0);
  return (numberAt(runs, run, "steps_rejected_newton") + numberAt(runs, run, "newton_restarts")) / steps;
}
double estimateTrouble(const Table& runs, const TableRow& run) {
  return numberAt(runs, run, "steps_rejected_error") / std::max(numberAt(runs, run, "steps_accepted"), 1.0);
}

// From the coarsest tolerance on, runs improve until one fails or is not more accurate than the one before it. The
// limit is Newton's method if its trouble per accepted step has grown there more than that of the error estimate,
// compared with the medians of the runs that still improve.
Limit limitOf(const Table& runs, std::vector<const TableRow*> series) {
  std::sort(series.begin(), series.end(),
            [&](auto* a, auto* b) { return numberAt(runs, *a, "rtol") > numberAt(runs, *b, "rtol"); });
  std::vector<double> newton, estimate;
  double error = kInfinity;
  for (const auto* run : series) {
    const double now = errorBoundAt(runs, *run);
    if (succeededAt(runs, *run) && now < error) {
      error = now;
      newton.push_back(newtonTrouble(runs, *run));
      estimate.push_back(estimateTrouble(runs, *run));
      continue;
    }
    if (newton.empty()) return Limit::kUnknown;
    if (textAt(runs, *run, "outcome") == "newton_failed") return Limit::kNewton;
    const double more_newton = newtonTrouble(runs, *run) - median(newton);
    const double more_estimate = estimateTrouble(runs, *run) - median(estimate);
    return more_newton > std::max(more_estimate, 0.0) ? Limit::kNewton : Limit::kOther;
  }
  return Limit::kUnknown;
}

Measurement observedOrder(const ResultTables& tables, Setting) {
  const Table& orders = tables.table("order", "orders");
  Measurement measured;
  for (const auto& row : orders.rows) {
    if (textAt(orders, row, "family") != "gauss" || stagesAt(orders, row) != 10) continue;
    measured.cases.push_back({textAt(orders, row, "scene"), numberAt(orders, row, "order")});
  }
  return measured;
}

Measurement costOfHighOrder(const ResultTables& tables, Setting setting) {
  constexpr double kHigh = 18;
  const Table runs = timedClaimRuns(tables, "stages", setting);
  const auto series = seriesOf(runs);
  Measurement measured;
  for (const auto& race : atSmallestError(runs, series, 3, {"control"})) {
    const double high = race.least([&](const TableRow& run) { return classicalOrder(runs, run) >= kHigh; });
    measured.cases.push_back({race.scene, high / race.least([](const TableRow&) { return true; })});
  }
  return measured;
}

Measurement fastestStages(const ResultTables& tables, Setting setting) {
  const Table runs = timedClaimRuns(tables, "stages", setting);
  const auto series = seriesOf(runs);
  Measurement measured;
  for (const auto& race : atSmallestError(runs, series, 3, {"control", "family"})) {
    const auto fastest = std::min_element(race.costs.begin(), race.costs.end(),
                                          [](const auto& a, const auto& b) { return a.second < b.second; });
    measured.cases.push_back({race.scene, stagesAt(runs, *fastest->first->rows.front())});
  }
  return measured;
}

Measurement limitOfManyStages(const ResultTables& tables, Setting setting) {
  const Table runs = timedClaimRuns(tables, "round_off", setting);
  // Both step controls must show it.
  std::map<TableRow, std::vector<Limit>> limits;
  for (const auto& series : seriesOf(runs)) {
    const TableRow& run = *series.rows.front();
    limits[{textAt(runs, run, "scene"), textAt(runs, run, "settings"), textAt(runs, run, "method")}].push_back(
        limitOf(runs, series.rows));
  }
  Measurement measured;
  for (const auto& [place, by_control] : limits) {
    const bool known =
        by_control.size() == 2 && std::find(by_control.begin(), by_control.end(), Limit::kUnknown) == by_control.end();
    const bool newton =
        std::all_of(by_control.begin(), by_control.end(), [](Limit one) { return one == Limit::kNewton; });
    measured.cases.push_back({place.front(), !known ? std::nan("") : newton ? 1.0 : 0.0});
  }
  return measured;
}

/// C7: `which` of the ends 0, 1, 2 of a scene. A run that ends because of its drift is a case as well; one that fails
/// for another reason has no drift.
Measurement driftOver(const ResultTables& tables, Setting setting, std::size_t which) {
  const Table runs = claimRuns(tables, "drift", setting);
  std::map<std::string, std::set<double>> ends;
  for (const auto& run : runs.rows) ends[textAt(runs, run, "scene")].insert(numberAt(runs, run, "t_end"));
  Measurement measured;
  std::size_t failed = 0;
  for (const auto& run : runs.rows) {
    const auto& scene = textAt(runs, run, "scene");
    const auto& times = ends[scene];
    if (times.size() <= which ||
        *std::next(times.begin(), static_cast<std::ptrdiff_t>(which)) != numberAt(runs, run, "t_end")) {
      continue;
    }
    if (succeededAt(runs, run) || textAt(runs, run, "outcome") == name(Outcome::kDrift)) {
      measured.cases.push_back({scene, numberAt(runs, run, "drift") / numberAt(runs, run, "error_u")});
    } else {
      ++failed;
    }
  }
  if (failed > 0) measured.remark = fmt::format("{} runs fail for another reason and have no drift.", failed);
  return measured;
}

Measurement newmarkDifference(const ResultTables&, Setting) {
  Measurement measured;
  for (const auto& [system, h, difference] : newmarkDifferences()) {
    measured.cases.push_back({std::string(system), difference});
  }
  return measured;
}

/// C13: at equal errors of this column.
Measurement radauFor(const ResultTables& tables, Setting setting, std::string_view error) {
  const Table runs = timedClaimRuns(tables, "families", setting);
  const auto series = seriesOf(runs);
  Measurement measured;
  std::map<std::string, int> best;
  for (const auto& race : races(runs, series, error)) {
    const auto ofFamily = [&](std::string_view family) {
      return race.least([&](const TableRow& run) { return textAt(runs, run, "family") == family; });
    };
    std::set<std::string> families;
    for (const auto& [one, cost] : race.costs) families.insert(textAt(runs, *one->rows.front(), "family"));
    if (families.size() < 2) continue;
    const double least = race.least([](const TableRow&) { return true; });
    for (const auto& family : families) best[family] += ofFamily(family) == least ? 1 : 0;
    measured.cases.push_back({race.scene, ofFamily("radau_iia") / least});
  }
  for (const auto& [family, times] : best) {
    measured.remark += fmt::format("{}{} {}", measured.remark.empty() ? "Cheapest, times: " : ", ", family, times);
  }
  return measured;
}

}  // namespace

Evaluations schemesEvaluations() {
  using Tables = const ResultTables&;
  return {
      {"C1a", observedOrder},
      {"C1b", costOfHighOrder},
      {"C2a", fastestStages},
      {"C2b", limitOfManyStages},
      {"C7a", [](Tables tables, Setting setting) { return driftOver(tables, setting, 0); }},
      {"C7b", [](Tables tables, Setting setting) { return driftOver(tables, setting, 1); }},
      {"C7c", [](Tables tables, Setting setting) { return driftOver(tables, setting, 2); }},
      {"C10", newmarkDifference},
      {"C13u", [](Tables tables, Setting setting) { return radauFor(tables, setting, "error_u"); }},
      {"C13v", [](Tables tables, Setting setting) { return radauFor(tables, setting, "error_v"); }},
      {"C13z", [](Tables tables, Setting setting) { return radauFor(tables, setting, "error_z"); }},
  };
}

}  // namespace irk::claims
