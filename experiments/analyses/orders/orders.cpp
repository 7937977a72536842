#include "experiments/analyses/orders/orders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>

#include "experiments/analyses/orders/order_fit.h"
#include "experiments/analyses/orders/row_theory.h"
#include "experiments/analyses/orders/theory.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/block_names.h"
#include "experiments/runs/run_spec.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/analysis.h"
#include "irk/scene.h"
#include "irk/tableaus.h"

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

// One letter for each group of components that the system has.
std::string componentLetters(const Sizes& n) {
  return (n.nu > 0 ? "uv" : "") + std::string(n.nx > 0 ? "x" : "") + std::string(n.nz > 0 ? "z" : "");
}

// Adds rows for a method without successful runs, one for each group of components of the system.
void appendFailure(const Table& runs, const TableRow& run, TableWriter& orders) {
  const auto kind = kindOf(runs, run, numberAt(runs, run, "h"));
  OrderFit fit;
  fit.reason = "no run succeeded: " + textAt(runs, run, "outcome");
  for (const char component : componentLetters(sizesOf(runs, run))) {
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

// What distinguishes two curves of theory, apart from family and component.
constexpr std::string_view kNames[] = {"scene", "settings", "formulation", "multipliers"};

struct Family {
  TableRow row;  // of its last series, with the finest step
  std::optional<SystemKind> kind;
  bool one_kind = true;
};

struct Group {
  std::map<std::string, Family> families;
  Index least = kMaxStages, most = 1;
  std::string blocks;
};

void add(const Table& runs, const RunSeries& series, Group& group) {
  const TableRow& row = *series.rows.back();
  const auto stages = static_cast<Index>(numberAt(runs, row, "stages"));
  const auto& family = textAt(runs, row, "family");
  if (textAt(runs, row, "method") != fmt::format("{}_{}", family, stages)) return;  // of a user's file
  group.least = std::min(group.least, stages);
  group.most = std::max(group.most, stages);
  addBlocks(group.blocks, series.blocks);
  const auto kind = kindOf(runs, row, numberAt(runs, row, "h"));
  const auto [at, added] = group.families.try_emplace(family, Family{row, kind});
  at->second.one_kind = at->second.one_kind && (added || at->second.kind == kind);
}

TableRow withStages(const Table& runs, TableRow row, const std::string& family, Index stages) {
  row[runs.column("stages")] = std::to_string(stages);
  row[runs.column("method")] = fmt::format("{}_{}", family, stages);
  return row;
}

void append(const Table& runs, const Group& group, const FamilyEntry& entry, TableWriter& table) {
  const auto found = group.families.find(entry.id);
  if (found == group.families.end() || !found->second.one_kind) return;
  const auto& [row, kind, one_kind] = found->second;
  for (const char component : componentLetters(sizesOf(runs, row))) {
    // One stage more on both sides: a single measured number of stages would give a line of one point.
    const Index first = std::max(group.least - 1, entry.min_stages), last = std::min<Index>(group.most + 1, kMaxStages);
    for (Index s = first; s <= last; ++s) {
      const TableRow member = withStages(runs, row, entry.id, s);
      const Theory theory = theoryFor(runs, member, kind, component);
      if (std::isnan(theory.order)) continue;
      TableRow line;
      for (const auto name : kNames) line.push_back(textAt(runs, row, name));
      for (const auto* name : {"method", "family", "stages"}) line.push_back(textAt(runs, member, name));
      line.insert(line.end(), {std::string(1, component), "h", numberText(theory.order), theory.source, group.blocks});
      table.add(line);
    }
  }
}

// order_theory.csv: the theoretical orders of the families of a study for every number of stages, measured or not. From
// runs.csv: for each scene, settings and formulation, each of its families and components, and every number of stages
// from one below the smallest to one above the largest there. Figures draw theory from it, so that numbers of stages
// that were not measured do not hide the steps between even and odd ones. Rows without a known order are left out.
void writeTheory(const RunFile& runs, const std::filesystem::path& file) {
  const Table& names = runs.names();
  TableWriter table(file, names.head,
                    {"scene", "settings", "formulation", "multipliers", "method", "family", "stages", "component",
                     "power_of", "theory", "source", std::string(kBlockColumn)});
  std::map<std::vector<std::string>, std::size_t> places;
  std::vector<Group> groups;  // in the order of the runs
  runs.forEachSeries([&](const RunSeries& series) {
    const TableRow& row = *series.rows.back();
    if (!hasFixedStepsAt(names, row)) return;
    std::vector<std::string> name;
    for (const auto column : kNames) name.push_back(textAt(names, row, column));
    const auto [at, added] = places.try_emplace(name, groups.size());
    if (added) groups.emplace_back();
    add(names, series, groups[at->second]);
  });
  for (const Group& group : groups) {
    for (const FamilyEntry& entry : familyCatalogue()) append(names, group, entry, table);
  }
  table.close();
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
  return {.key = "orders",
          .meaning = "observed orders of convergence, with what theory says",
          .writes = "orders.csv order_theory.csv",
          .run = [](const AnalysisInput& in) {
            writeOrders(in.runs, in.folder / "orders.csv");
            writeTheory(in.runs, in.folder / "order_theory.csv");
          }};
}

}  // namespace irk
