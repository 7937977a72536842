// Claims about switches, contact and friction, and about how reliable step doubling is.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "experiments/claims/evaluations.h"
#include "experiments/claims/measures.h"
#include "experiments/runs/fields.h"
#include "experiments/solution/trajectory.h"

namespace irk::claims {
namespace {

// The largest error of u, v and x; NaN if none is known.
double differentialError(const Table& runs, const TableRow& run) {
  double largest = std::nan("");
  for (const auto* column : {"error_u", "error_v", "error_x"}) {
    const double error = numberAt(runs, run, column);
    if (!(largest >= error) && !std::isnan(error)) largest = error;
  }
  return largest;
}

double overTolerance(const Table& runs, const TableRow& run) {
  return differentialError(runs, run) / numberAt(runs, run, "rtol");
}

// --- C3b, runs; C16

constexpr std::size_t kLeastRuns = 50;
const Blocks kWithJumps = {"contact",  "friction",     "yielding",          "chopper",
                           "sampling", "torque_level", "rod_with_friction", "arm_on_stop"};
const Blocks kWithoutJumps = {"orbit", "pendulum", "tracking", "singular_perturbation",
                              "stiff", "beam",     "index1",   "index2"};

TableRow tolerancePlace(const Table& runs, const TableRow& run) {
  return {textAt(runs, run, "scene"), textAt(runs, run, "settings"), textAt(runs, run, "method"),
          textAt(runs, run, "rtol")};
}

// --- C9b

struct Switched {
  const char* block;
  std::vector<double> times;  // of the switches of the exact solution
};
const std::vector<Switched> kLively = {{"torque_level", {0.5}},
                                       {"sampling", {0.1, 0.2, 0.3, 0.4}},
                                       {"chopper", {0.002337477488598, 0.007248769114225, 0.008261944369415}}};

// The solution of a run of the study steps over time.
const Table& stepsOf(const ResultTables& tables, const Table& runs, const TableRow& run) {
  RunSpec spec;
  for (const char* field : {"scene", "settings", "method"}) findField(field).set(spec, textAt(runs, run, field));
  return tables.table("steps", trajectoryPath({}, spec).stem().string());
}

// The smaller of two steps: the one that contains t, and the next one. NaN behind the end.
double stepAt(const Table& steps, double t) {
  for (auto row = steps.rows.begin(); row != steps.rows.end(); ++row) {
    if (numberAt(steps, *row, "t") < t) continue;
    const double h = numberAt(steps, *row, "h");
    return row + 1 == steps.rows.end() ? h : std::min(h, numberAt(steps, row[1], "h"));
  }
  return std::nan("");
}

// --- C18

constexpr double kClean = 0.1;  // error of a solution that can be used

/// C3b: of a group u, v, x.
Measurement reliableSteps(const ResultTables& tables, std::string_view group) {
  const Table& estimates = tables.table("estimate", "estimates");
  Measurement measured;
  for (const auto& step : estimates.rows) {
    // The paper integrates in index 2.
    if (textAt(estimates, step, "group") != group || textAt(estimates, step, "formulation") == "index3") continue;
    measured.cases.push_back({textAt(estimates, step, "scene"), numberAt(estimates, step, "doubling")});
  }
  return measured;
}

Measurement reliableRuns(const ResultTables& tables, Setting setting) {
  const Table jumps = where(timedRuns(tables, "reliability", kWithJumps, setting), {{"discontinuity", "ignore"}});
  const Table smooth = timedRuns(tables, "reliability", kWithoutJumps, setting);
  Measurement measured;
  std::size_t counts[2] = {0, 0}, failed = 0;
  for (const Table* runs : {&jumps, &smooth}) {
    for (const auto& run : runs->rows) {
      const bool succeeded = succeededAt(*runs, run);
      failed += succeeded ? 0 : 1;
      const double value = succeeded ? overTolerance(*runs, run) : kInfinity;
      if (std::isnan(value)) continue;
      measured.cases.push_back({textAt(*runs, run, "scene"), value});
      ++counts[runs == &jumps ? 0 : 1];
    }
  }
  if (counts[0] < kLeastRuns / 2 || counts[1] < kLeastRuns / 2) {
    return cannotMeasure("study reliability lacks 25 runs with jumps, or 25 without");
  }
  measured.remark = std::to_string(counts[0]) + " runs with jumps, " + std::to_string(counts[1]) + " without; " +
                    std::to_string(failed) + " of them failed and do not reach their tolerance.";
  return measured;
}

/// C16: error over tolerance of runs that treat switches so; what fails does not reach its tolerance.
Measurement reachedTolerances(const ResultTables& tables, Setting setting, std::string_view treatment) {
  const Table all = timedRuns(tables, "reliability", kWithJumps, setting);
  const Table runs = where(all, {{"discontinuity", treatment}});
  Measurement measured;
  for (const auto& run : runs.rows) {
    const double value = succeededAt(runs, run) ? overTolerance(runs, run) : kInfinity;
    measured.cases.push_back({textAt(runs, run, "scene"), value});
  }
  return measured;
}

/// C16: residuals over those of the run that locates its switches, where both succeed.
Measurement costOverLocating(const ResultTables& tables, Setting setting, std::string_view treatment) {
  const Table runs = timedRuns(tables, "reliability", kWithJumps, setting);
  std::map<TableRow, double> located;
  for (const auto& run : where(runs, {{"discontinuity", "locate"}, {"outcome", "success"}}).rows) {
    located[tolerancePlace(runs, run)] = evaluationsAt(runs, run);
  }
  Measurement measured;
  for (const auto& run : where(runs, {{"discontinuity", treatment}, {"outcome", "success"}}).rows) {
    const auto at = located.find(tolerancePlace(runs, run));
    if (at == located.end()) continue;
    measured.cases.push_back({textAt(runs, run, "scene"), evaluationsAt(runs, run) / at->second});
  }
  return measured;
}

Measurement stepAtSwitch(const ResultTables& tables, Setting) {
  Measurement measured;
  for (const auto& [block, times] : kLively) {
    const Table runs = inBlocks(tables, "steps", {block});
    for (const auto& run : runs.rows) {
      if (!succeededAt(runs, run)) continue;
      const Table& steps = stepsOf(tables, runs, run);
      const double usual = median(numbersOf(steps, "h"));
      for (const double t : times) measured.cases.push_back({textAt(runs, run, "scene"), stepAt(steps, t) / usual});
    }
  }
  return measured;
}

Measurement contractionAtFirst(const ResultTables& tables, Setting) {
  const Table& solves = tables.table("contraction", "contractions");
  Measurement measured;
  for (const auto& solve : solves.rows) {
    measured.cases.push_back(
        {textAt(solves, solve, "scene"), numberAt(solves, solve, "c3") / numberAt(solves, solve, "c1")});
  }
  return measured;
}

Measurement repairedByFullNewton(const ResultTables& tables, Setting) {
  const Table& runs = tables.runs("newton_contact");
  std::map<std::pair<TableRow, TableRow>, const TableRow*> full;
  const auto keyOf = [&](const TableRow& run) {
    return std::pair(tolerancePlace(runs, run), TableRow{textAt(runs, run, "discontinuity"), textAt(runs, run, "h")});
  };
  for (const auto& run : runs.rows) {
    if (textAt(runs, run, "newton") == "full") full[keyOf(run)] = &run;
  }
  Measurement measured;
  for (const auto& run : runs.rows) {
    if (textAt(runs, run, "newton") != "modified_only") continue;
    const auto other = full.find(keyOf(run));
    if (other == full.end()) continue;
    const bool repaired = textAt(runs, run, "outcome") == name(Outcome::kNewtonFailed) &&
                          succeededAt(runs, *other->second) && numberAt(runs, *other->second, "error") <= kClean;
    measured.cases.push_back({textAt(runs, run, "scene"), repaired ? 1.0 : 0.0});
  }
  return measured;
}

Measurement rejectedWithGamma(const ResultTables& tables, Setting) {
  const Table runs = inBlocks(tables, "control",
                              {"gamma_smooth", "gamma_crank", "gamma_crank_torque_off", "gamma_arm", "gamma_friction"});
  struct Rejected {
    double with = 0, without = 0;
  };
  std::map<TableRow, std::map<std::string, Rejected>> tolerances;  // by scene, settings, method
  std::map<TableRow, std::map<std::string, int>> found;
  for (const auto& run : runs.rows) {
    if (!succeededAt(runs, run)) continue;
    TableRow place = tolerancePlace(runs, run);
    place.pop_back();
    const auto& rtol = textAt(runs, run, "rtol");
    const double rejected = numberAt(runs, run, "steps_rejected_error");
    Rejected& both = tolerances[place][rtol];
    ++found[place][rtol];
    (textAt(runs, run, "control") == "paper" ? both.with : both.without) = rejected;
  }
  Measurement measured;
  for (const auto& [place, list] : tolerances) {
    Rejected sum;
    for (const auto& [rtol, both] : list) {
      if (found[place][rtol] != 2) continue;
      sum.with += both.with;
      sum.without += both.without;
    }
    if (sum.with + sum.without == 0) continue;
    measured.cases.push_back({place.front(), sum.with / std::max(sum.without, 1.0)});
  }
  return measured;
}

Measurement gainOnFlexibleContact(const ResultTables& tables, Setting setting) {
  const Blocks ignored{"rod_with_friction", "arm_on_stop", "arm_on_smooth_stop", "leaf_on_stop"};
  const Blocks located{"rod_with_friction_located", "arm_on_stop_located", "arm_on_smooth_stop_located",
                       "leaf_on_stop_located"};
  const Table runs = timedRuns(tables, "flexible_contact", setting == Setting::kPaper ? ignored : located, setting);
  const auto series = seriesOf(runs);
  Measurement measured;
  for (const auto& race : races(runs, series, "error")) {
    const auto stages = [&](const TableRow& run) { return numberAt(runs, run, "stages"); };
    const double few = race.least([&](const TableRow& run) { return stages(run) == 2; });
    const double many = race.least([&](const TableRow& run) { return stages(run) >= 5; });
    if (std::isfinite(few) && std::isfinite(many)) measured.cases.push_back({race.scene, few / many});
  }
  return measured;
}

}  // namespace

Evaluations switchingEvaluations() {
  using Tables = const ResultTables&;
  return {
      {"C3bu", [](Tables tables, Setting) { return reliableSteps(tables, "u"); }},
      {"C3bv", [](Tables tables, Setting) { return reliableSteps(tables, "v"); }},
      {"C3bx", [](Tables tables, Setting) { return reliableSteps(tables, "x"); }},
      {"C3br", reliableRuns},
      {"C9b", stepAtSwitch},
      {"C16a", [](Tables tables, Setting setting) { return reachedTolerances(tables, setting, "ignore"); }},
      {"C16b", [](Tables tables, Setting setting) { return reachedTolerances(tables, setting, "iterate"); }},
      {"C16c", [](Tables tables, Setting setting) { return costOverLocating(tables, setting, "ignore"); }},
      {"C16d", [](Tables tables, Setting setting) { return costOverLocating(tables, setting, "iterate"); }},
      {"C17", contractionAtFirst},
      {"C18", repairedByFullNewton},
      {"C19", rejectedWithGamma},
      {"C20", gainOnFlexibleContact},
  };
}

}  // namespace irk::claims
