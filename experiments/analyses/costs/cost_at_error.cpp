#include "experiments/analyses/costs/cost_at_error.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

#include "experiments/base/numbers.h"
#include "experiments/runs/block_names.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/analysis.h"
#include "experiments/study/study.h"

namespace irk {
namespace {

constexpr std::string_view kCosts[] = {"cpu_s", "residuals", "newton_iterations", "jacobians", "factorizations"};

// The lower envelope, from cheap to expensive: each point is more accurate than all cheaper ones.
std::vector<CostPoint> envelope(std::vector<CostPoint> points) {
  std::erase_if(points, [](const CostPoint& p) { return !(p.error > 0) || !(p.cost > 0); });
  std::sort(points.begin(), points.end(),
            [](auto& a, auto& b) { return std::tie(a.cost, a.error) < std::tie(b.cost, b.error); });
  std::vector<CostPoint> best;
  for (const auto& p : points) {
    if (best.empty() || p.error < best.back().error) best.push_back(p);
  }
  return best;
}

// The reason why a series does not reach an error.
std::string causeOf(const Table& runs, const RunSeries& series) {
  bool succeeded = false, known = false, measurable = true;
  for (const auto* run : series.rows) {
    if (!succeededAt(runs, *run)) continue;
    succeeded = true;
    known = known || !std::isnan(numberAt(runs, *run, "error"));
    measurable = measurable && !notMeasurableAt(runs, *run);
  }
  if (!succeeded) return "no success: " + textAt(runs, *series.rows.back(), "outcome");
  if (!measurable) return std::string(kNotMeasurable);
  return known ? "not accurate enough" : std::string(kNoReference);
}

// The smallest tolerance that a run of the series was given; NaN for fixed steps, and for tables without tolerances.
double leastTolerance(const Table& runs, const RunSeries& series) {
  double least = std::numeric_limits<double>::quiet_NaN();
  if (!runs.hasColumn("control") || !runs.hasColumn("rtol") || !runs.hasColumn("atol")) return least;
  for (const auto* run : series.rows) {
    if (hasFixedStepsAt(runs, *run)) continue;
    const double rtol = numberAt(runs, *run, "rtol"), atol = numberAt(runs, *run, "atol");
    const double tolerance = rtol > 0 ? rtol : atol;
    if (!(tolerance >= least)) least = tolerance;
  }
  return least;
}

}  // namespace

double costAtError(std::vector<CostPoint> points, double target) {
  const auto best = envelope(std::move(points));
  const auto at = std::find_if(best.begin(), best.end(), [target](const CostPoint& p) { return p.error <= target; });
  if (at == best.end()) return std::numeric_limits<double>::quiet_NaN();
  if (at == best.begin()) return at->cost;
  const auto& before = *(at - 1);
  const double part = std::log(before.error / target) / std::log(before.error / at->error);
  return before.cost * std::pow(at->cost / before.cost, part);
}

double seriesCostAtError(const Table& runs, const RunSeries& series, std::string_view cost, double target) {
  std::vector<CostPoint> points;
  for (const auto* run : series.rows) {
    if (!succeededAt(runs, *run)) continue;
    points.push_back({errorBoundAt(runs, *run), numberAt(runs, *run, cost)});
  }
  return costAtError(std::move(points), target);
}

bool isComparable(const Table& costs, const TableRow& row) {
  const auto& cause = textAt(costs, row, "cause");
  if (cause == kNoReference || cause == kNotMeasurable || cause == kNotApplicable) return false;
  if (!costs.hasColumn("least_tolerance")) return true;
  const double least = numberAt(costs, row, "least_tolerance");
  return !(least > numberAt(costs, row, "target_error") * (1 + 1e-9));
}

void writeCosts(const RunFile& runs, const std::vector<double>& targets, const std::filesystem::path& file) {
  const Table& names = runs.names();
  auto columns = seriesColumns(names);
  columns.emplace_back("target_error");
  columns.insert(columns.end(), std::begin(kCosts), std::end(kCosts));
  columns.insert(columns.end(), {"reached", "cause", "least_tolerance", std::string(kBlockColumn)});
  TableWriter costs(file, names.head, columns);
  runs.forEachSeries([&](const RunSeries& series) {
    for (const double target : targets) {
      TableRow row = series.name;
      row.push_back(numberText(target));
      bool reached = false;
      for (const auto cost : kCosts) {
        const double value = seriesCostAtError(names, series, cost, target);
        reached = reached || !std::isnan(value);
        row.push_back(numberText(value));
      }
      row.emplace_back(reached ? "1" : "0");
      row.push_back(reached ? "" : causeOf(names, series));
      row.push_back(numberText(leastTolerance(names, series)));
      row.push_back(series.blocks);
      costs.add(row);
    }
  });
  costs.close();
}

Analysis costAnalysis() {
  return {
      .key = "targets",
      .id = "cost",
      .meaning = "what each method costs at the errors of `targets`",
      .writes = "cpu_at_error.csv",
      .run = [](const AnalysisInput& in) { writeCosts(in.runs, in.study.targets, in.folder / "cpu_at_error.csv"); }};
}

}  // namespace irk
