// Claims about error estimates, step control and discontinuities.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/analyses/line_fit.h"
#include "experiments/claims/evaluations.h"
#include "experiments/claims/measures.h"

namespace irk::claims {
namespace {

TableRow methodPlace(const Table& runs, const TableRow& run) {
  return {textAt(runs, run, "scene"), textAt(runs, run, "settings"), textAt(runs, run, "method")};
}

// --- C8

using Cost = double (*)(const Table& runs, const TableRow& run);

// Per scene, tolerance and kind of method: the slope of a cost over the number of located switches.
std::map<TableRow, std::map<std::string, double>> slopes(const Table& runs, Cost cost) {
  constexpr std::size_t kMinPoints = 4;
  struct Points {
    std::vector<double> switches, costs;
  };
  std::map<TableRow, std::map<std::string, Points>> points;
  for (const auto& run : runs.rows) {
    if (!succeededAt(runs, run)) continue;
    Points& its = points[{textAt(runs, run, "scene"), textAt(runs, run, "rtol")}][textAt(runs, run, "method")];
    its.switches.push_back(numberAt(runs, run, "located_events"));
    its.costs.push_back(cost(runs, run));
  }
  std::map<TableRow, std::map<std::string, double>> all;
  for (const auto& [place, methods] : points) {
    for (const auto& [method, its] : methods) {
      if (its.costs.size() < kMinPoints) continue;
      const auto [least, most] = std::minmax_element(its.switches.begin(), its.switches.end());
      if (*least < *most) all[place][method] = fitLine(its.switches, its.costs).slope;
    }
  }
  return all;
}

double stepsAt(const Table& runs, const TableRow& run) { return numberAt(runs, run, "steps_accepted"); }
double secondsAt(const Table& runs, const TableRow& run) { return numberAt(runs, run, "cpu_s"); }

/// C8: each BDF code over each Radau IIA, the slope of this cost.
Measurement perRestart(const ResultTables& tables, Cost cost) {
  const Table runs = claimRuns(tables, "restarts");
  if (runs.rows.empty()) throw MissingResults("study claims lacks the runs of the blocks restarts");
  Measurement measured;
  std::size_t pairs = 0;
  for (const auto& [place, methods] : slopes(runs, cost)) {
    for (const auto& [radau, steps] : methods) {
      if (!radau.starts_with("radau")) continue;
      for (const auto& [bdf, more_steps] : methods) {
        if (bdf.find("bdf") == bdf.npos) continue;
        ++pairs;
        if (steps > 0) measured.cases.push_back({place.front(), more_steps / steps});
      }
    }
  }
  measured.remark = fmt::format("in {} of {} pairs the cost of Radau IIA does not grow with the switches: no ratio.",
                                pairs - measured.cases.size(), pairs);
  return measured;
}

Measurement costOfDoubling(const ResultTables& tables, Setting setting) {
  const auto inBlock = [&](std::string_view block) {
    return where(claimRuns(tables, block, setting), {{"outcome", "success"}});
  };
  const Table plain = inBlock("plain_steps"), doubled = inBlock("doubled_steps");
  std::map<TableRow, const TableRow*> same;
  for (const auto& run : plain.rows) same[methodPlace(plain, run)] = &run;
  Measurement measured;
  for (const auto& run : doubled.rows) {
    const auto at = same.find(methodPlace(doubled, run));
    if (at == same.end()) continue;
    // Both take the same steps: two halves for each doubled step, and no step is rejected.
    const bool same_steps =
        numberAt(plain, *at->second, "steps_accepted") == 2 * numberAt(doubled, run, "steps_accepted") &&
        numberAt(doubled, run, "steps_rejected_error") == 0;
    if (!same_steps) continue;
    measured.cases.push_back({textAt(doubled, run, "scene"),
                              numberAt(doubled, run, "residuals") / numberAt(plain, *at->second, "residuals")});
  }
  return measured;
}

Measurement gainBetweenSwitches(const ResultTables& tables, Setting setting) {
  const Table all = timedClaimRuns(tables, "stages", setting);
  const Table runs = where(all, {{"family", "radau_iia"}});
  const auto series = seriesOf(runs);
  Measurement measured;
  for (const auto& race : races(runs, series, "error", {"control"})) {
    const auto stages = [&](const TableRow& run) { return numberAt(runs, run, "stages"); };
    const double few = race.least([&](const TableRow& run) { return stages(run) == 2; });
    const double many = race.least([&](const TableRow& run) { return stages(run) >= 5; });
    if (std::isfinite(few) && std::isfinite(many)) measured.cases.push_back({race.scene, few / many});
  }
  return measured;
}

Measurement absoluteTolerances(const ResultTables& tables, Setting setting) {
  const Table absolute = timedClaimRuns(tables, "norm_absolute", setting);
  const Table mixed = timedClaimRuns(tables, "norm_mixed", setting);
  const Table relative = timedClaimRuns(tables, "norm_relative", setting);
  std::map<std::pair<TableRow, double>, double> others;  // the least cost
  for (const Table* runs : {&mixed, &relative}) {
    for (const auto& series : seriesOf(*runs)) {
      for (const double error : comparedErrors()) {
        const double cost = seriesCost(*runs, series, "cpu_s", "error", error);
        if (std::isnan(cost)) continue;
        const auto at = others.try_emplace({methodPlace(*runs, *series.rows.front()), error}, cost).first;
        at->second = std::min(at->second, cost);
      }
    }
  }
  Measurement measured;
  for (const auto& series : seriesOf(absolute)) {
    const TableRow place = methodPlace(absolute, *series.rows.front());
    for (const double error : comparedErrors()) {
      const double cost = seriesCost(absolute, series, "cpu_s", "error", error);
      const auto other = others.find({place, error});
      if (!std::isnan(cost) && other != others.end()) measured.cases.push_back({place.front(), cost / other->second});
    }
  }
  return measured;
}

}  // namespace

Evaluations controlEvaluations() {
  using Tables = const ResultTables&;
  return {
      {"C3a", costOfDoubling},
      {"C8a", [](Tables tables, Setting) { return perRestart(tables, stepsAt); }},
      {"C8b", [](Tables tables, Setting) { return perRestart(tables, secondsAt); }},
      {"C8c", [](Tables tables, Setting) { return perRestart(tables, evaluationsAt); }},
      {"C9a", gainBetweenSwitches},
      {"C14", absoluteTolerances},
  };
}

}  // namespace irk::claims
