#include "experiments/analyses/orders/orders.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>

#include "experiments/analyses/orders/order_fit.h"
#include "experiments/analyses/orders/row_theory.h"
#include "experiments/analyses/orders/theory.h"
#include "experiments/analyses/orders/theory_table.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/block_names.h"
#include "experiments/runs/run_spec.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/analysis.h"
#include "irk/scene.h"

namespace irk {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

std::string verdictText(const OrderFit& fit, double theory) {
  if (!fit.measurable) return "not_measurable";
  if (std::isnan(theory)) return "no_theory";
  return std::abs(fit.order - theory) <= orderTolerance(theory) ? "agrees" : "differs";
}

// A slope that differs from every integer by more than this is not an order.
constexpr double kNoInteger = 0.2;

// For algebraic and stiff systems theory gives a bound, which single components can exceed. That they do shows in more
// than one window of steps; what exceeds it in one only can have another cause, as errors that are not of the scheme.
std::string reasonText(const OrderFit& fit, const OrderFit& second, double theory, SystemKind kind) {
  const bool differs = fit.measurable && std::abs(fit.order - theory) > orderTolerance(theory);
  if (!differs) return fit.reason;
  if (std::abs(fit.order - std::round(fit.order)) > kNoInteger) {
    return "no integer: the steps are not yet asymptotic where round-off comes";
  }
  if (kind == SystemKind::kOde) return fit.reason;
  if (fit.order < theory) return "lower than theory for this kind of system";
  if (!second.measurable) return "higher than the general result; no second window of steps shows it";
  const auto where = fmt::format("{:.1e} to {:.1e}", second.h_max, second.h_min);
  if (std::abs(second.order - fit.order) > orderTolerance(fit.order)) {
    return fmt::format("higher than the general result; the steps {} have {:.4g}", where, second.order);
  }
  return fmt::format("higher than the general result, also at the steps {}: this system does not excite its worst term",
                     where);
}

OrderFitOptions fitOptions(const Table& runs, const TableRow& row, std::optional<SystemKind> kind) {
  OrderFitOptions options;
  options.epsilon = epsilonOf(parseId<ScalarKind>(textAt(runs, row, "scalar")));
  const bool ode = kind == SystemKind::kOde;
  if (ode && isSymmetric(textAt(runs, row, "family"))) options.next_power = 2;
  return options;
}

TableRow orderRow(const Table& runs, const TableRow& run, char component, std::string power_of, const OrderFit& fit,
                  const Theory& theory, const std::string& reason) {
  TableRow row;
  for (const auto* name : {"scene", "settings", "formulation", "multipliers", "scalar", "method", "family", "stages"}) {
    row.push_back(textAt(runs, run, name));
  }
  row.emplace_back(1, component);
  row.push_back(std::move(power_of));
  for (const double x : {fit.order, fit.confidence, fit.h_min, fit.h_max}) {
    row.push_back(numberText(fit.measurable ? x : kUnknown));
  }
  row.push_back(std::to_string(fit.points));
  row.push_back(numberText(theory.order));
  row.push_back(theory.source);
  row.push_back(verdictText(fit, theory.order));
  row.push_back(reason);
  row.push_back(runs.hasColumn(kBlockColumn) ? textAt(runs, run, kBlockColumn) : "");
  return row;
}

void appendOrders(const Table& runs, const std::vector<const TableRow*>& series, TableWriter& orders) {
  // The fine end of the steps is asymptotic; it also decides whether the system counts as stiff.
  const TableRow& finest = *series.back();
  const auto kind = kindOf(runs, finest, numberAt(runs, finest, "h"));
  for (const char component : {'u', 'v', 'x', 'z'}) {
    const std::string column = std::string("error_") + component;
    std::vector<ErrorPoint> points;
    bool known = false;
    for (const auto* row : series) {
      points.push_back({numberAt(runs, *row, "h"), numberAt(runs, *row, column)});
      known = known || !std::isnan(points.back().error);
    }
    if (!known) continue;
    const auto options = fitOptions(runs, finest, kind);
    const OrderFit fit = fitOrder(points, options);
    const Theory theory = theoryFor(runs, finest, kind, component);
    const auto second = fit.measurable ? secondWindow(points, fit, options) : OrderFit{};
    const auto reason = reasonText(fit, second, theory.order, kind.value_or(SystemKind::kOde));
    orders.add(orderRow(runs, finest, component, "h", fit, theory, reason));
  }
}

/// Errors of one method at one step over 1 / |z|, z = h lambda.
struct AtStep {
  TableRow first;  // of its runs
  std::vector<ErrorPoint> points;
};
using OverZ = std::map<double, AtStep>;  // by h

void appendPowerOfZ(const Table& runs, const OverZ& over_z, TableWriter& orders) {
  // The finest step at which all values of z have runs.
  std::size_t most = 0;
  for (const auto& [h, found] : over_z) most = std::max(most, found.points.size());
  for (const auto& [h, found] : over_z) {
    const auto& [run, points] = found;
    if (points.size() < most) continue;
    OrderFit fit = fitOrder(points, fitOptions(runs, run, SystemKind::kStiffPowerOfZ));
    fit.order = -fit.order;
    const Theory theory = theoryFor(runs, run, SystemKind::kStiffPowerOfZ, 'x');
    orders.add(orderRow(runs, run, 'x', "z", fit, theory, fit.reason));
    return;
  }
}

// Adds rows for a method without successful runs, one for each group of components of the system.
void appendFailure(const Table& runs, const TableRow& run, TableWriter& orders) {
  const auto kind = kindOf(runs, run, numberAt(runs, run, "h"));
  const Sizes n = sizesOf(runs, run);
  OrderFit fit;
  fit.reason = "no run succeeded: " + textAt(runs, run, "outcome");
  const std::string components =
      (n.nu > 0 ? "uv" : "") + std::string(n.nx > 0 ? "x" : "") + std::string(n.nz > 0 ? "z" : "");
  for (const char component : components) {
    const Theory theory = theoryFor(runs, run, kind, component);
    orders.add(orderRow(runs, run, component, "h", fit, theory, fit.reason));
  }
}

std::vector<const TableRow*> successes(const Table& runs, const RunSeries& series) {
  std::vector<const TableRow*> rows;
  for (const auto* row : series.rows) {
    if (succeededAt(runs, *row)) rows.push_back(row);
  }
  return rows;
}

}  // namespace

void writeOrders(const RunFile& runs, const std::filesystem::path& file) {
  const Table& names = runs.names();
  TableWriter orders(file, names.head,
                     {"scene",  "settings",   "formulation", "multipliers", "scalar",
                      "method", "family",     "stages",      "component",   "power_of",
                      "order",  "confidence", "h_min",       "h_max",       "points",
                      "theory", "source",     "verdict",     "reason",      std::string(kBlockColumn)});
  std::map<std::string, OverZ> over_z;  // by method
  runs.forEachSeries([&](const RunSeries& series) {
    if (!hasFixedStepsAt(names, *series.rows.front())) return;
    const auto rows = successes(names, series);
    if (rows.empty()) {
      appendFailure(names, *series.rows.back(), orders);
      return;
    }
    appendOrders(names, rows, orders);
    const SceneEntry& scene = findScene(textAt(names, *rows.front(), "scene"));
    const std::string z = stiffnessText(scene, textAt(names, *rows.front(), "settings"));
    if (scene.kind != SceneKind::kStiffTest || !z.ends_with("/h")) return;
    for (const auto* row : rows) {
      auto& [first, points] = over_z[textAt(names, *row, "method")][numberAt(names, *row, "h")];
      if (points.empty()) first = *row;
      points.push_back({1 / std::abs(std::strtod(z.c_str(), nullptr)), numberAt(names, *row, "error_x")});
    }
  });
  for (const auto& [method, errors] : over_z) appendPowerOfZ(names, errors, orders);
  orders.close();
}

Analysis ordersAnalysis() {
  return {.id = "orders",
          .key = "orders",
          .meaning = "observed orders of convergence, with what theory says",
          .reads = "runs.csv",
          .writes = "orders.csv order_theory.csv",
          .run = [](const AnalysisInput& in) {
            writeOrders(in.runs, in.folder / "orders.csv");
            writeTheory(in.runs, in.folder / "order_theory.csv");
          }};
}

}  // namespace irk
