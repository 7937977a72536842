#include "experiments/analyses/scaling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "experiments/analyses/line_fit.h"
#include "experiments/base/clock.h"
#include "experiments/base/median.h"
#include "experiments/base/numbers.h"
#include "experiments/base/progress.h"
#include "experiments/runs/run_table.h"
#include "experiments/runs/setup.h"
#include "experiments/study/analysis.h"

namespace irk {
namespace {

constexpr std::size_t kFirstSteps = 3;  // not counted
constexpr double kMinUnknowns = 200;    // for a slope over n
constexpr std::size_t kMinPoints = 3;   // for a slope
constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

struct StepCost {
  double n = 0, wall_s = kNotMeasured, cpu_s = kNotMeasured, iterations = kNotMeasured;
};

StepCost measure(const RunSpec& spec) {
  const auto setup = makeSetup<double>(spec);
  auto integrator = setup.integrator();
  std::vector<double> wall, cpu, iterations;
  double wall_before = wallSeconds(), cpu_before = threadSeconds();
  Monitor<double> monitor;
  monitor.accepted = [&](const StepRecord<double>& step) {
    wall.push_back(wallSeconds() - wall_before);
    cpu.push_back(threadSeconds() - cpu_before);
    iterations.push_back(step.newton_iterations);
    wall_before = wallSeconds();
    cpu_before = threadSeconds();
  };
  const auto solution = integrator.integrate(setup.scene.start, setup.spec.t_end, monitor);
  StepCost cost;
  cost.n = static_cast<double>(setup.system->sizes().n());
  if (solution.outcome != Outcome::kSuccess || wall.size() <= kFirstSteps) return cost;
  for (auto* values : {&wall, &cpu, &iterations}) {
    values->erase(values->begin(), values->begin() + static_cast<std::ptrdiff_t>(kFirstSteps));
  }
  cost.wall_s = median(wall);
  cost.cpu_s = median(cpu);
  cost.iterations = median(iterations);
  return cost;
}

// x is the log of the varied column, y the log of the time.
struct Points {
  std::vector<double> x, y;
};

TableRow slopeRow(TableRow row, const Points& points) {
  const LineFit fit = fitLine(points.x, points.y);
  const std::size_t count = points.x.size();
  row.push_back(numberText(fit.slope));
  row.push_back(numberText(slopeConfidence(fit, count)));
  row.push_back(std::to_string(count));
  return row;
}

}  // namespace

Table scalingTable(const Study& study, const RunFile& runs, std::ostream& out) {
  const Table& names = runs.names();
  Table table{names.head, seriesColumns(names), {}};
  table.columns.insert(table.columns.end(), {"n", "step_s", "step_cpu_s", "iterations"});
  Progress progress(out, study.id + " steps");
  repeatRuns(study, runs, &progress, [&](const RunSeries& series, const TableRow&, const RunSpec& spec) {
    const StepCost cost = measure(spec);
    TableRow row = series.name;
    for (const double x : {cost.n, cost.wall_s, cost.cpu_s, cost.iterations}) row.push_back(numberText(x));
    table.rows.push_back(std::move(row));
  });
  return table;
}

Table scalingSlopes(const Table& scaling) {
  Table slopes{scaling.head,
               {"scene", "formulation", "solver", "storage", "threads", "over", "at", "slope", "confidence", "points"},
               {}};
  std::map<TableRow, Points> series;
  for (const auto& row : scaling.rows) {
    // As in plots/scaling.gp: other load does not disturb the CPU clock, but it does not see the other threads.
    const bool one_thread = textAt(scaling, row, "threads") == "1";
    const double n = numberAt(scaling, row, "n"), time = numberAt(scaling, row, one_thread ? "step_cpu_s" : "step_s");
    if (!(time > 0)) continue;
    TableRow name;
    for (const char* column : {"scene", "formulation", "solver", "storage", "threads"}) {
      name.push_back(textAt(scaling, row, column));
    }
    const auto add = [&](const char* over, const std::string& at, double x) {
      TableRow key = name;
      key.emplace_back(over);
      key.push_back(at);
      series[key].x.push_back(std::log(x));
      series[key].y.push_back(std::log(time));
    };
    if (n >= kMinUnknowns) add("n", textAt(scaling, row, "method"), n);
    add("stages", textAt(scaling, row, "n"), numberAt(scaling, row, "stages"));
  }
  for (const auto& [name, points] : series) {
    const auto [low, high] = std::minmax_element(points.x.begin(), points.x.end());
    if (points.x.size() < kMinPoints || *low == *high) continue;
    slopes.rows.push_back(slopeRow(name, points));
  }
  return slopes;
}

Analysis scalingAnalysis() {
  return {.key = "scaling",
          .meaning = "the time of a step over unknowns, stages and threads, with slopes",
          .writes = "scaling.csv scaling_slopes.csv",
          .one_method = "the time of a step is compared between methods of fixed stages",
          .run = [](const AnalysisInput& in) {
            const Table scaling = scalingTable(in.study, in.runs, in.progress);
            writeTable(in.folder / "scaling.csv", scaling);
            writeTable(in.folder / "scaling_slopes.csv", scalingSlopes(scaling));
          }};
}

}  // namespace irk
