#include "experiments/orders.h"

#include <cmath>
#include <limits>
#include <optional>

#include "experiments/numbers.h"
#include "experiments/order_fit.h"
#include "experiments/run_table.h"
#include "experiments/theory.h"
#include "problems/scene.h"
#include "tableaus/catalogue.h"

namespace irk {
namespace {

constexpr double kAgreement = 0.2;

std::optional<SystemKind> kindOf(const std::string& scene, const std::string& formulation) {
  const Sizes n = makeScene<double>(scene).sizes();
  if (n.nz == 0 || formulation == "first_order") return SystemKind::kOde;
  if (n.constraints < n.nz) return {};
  return formulation == "index3" ? SystemKind::kIndex3 : SystemKind::kIndex2;
}

std::vector<const TableRow*> successes(const Table& runs, const RunSeries& series) {
  std::vector<const TableRow*> rows;
  for (const auto* row : series.rows) {
    if (succeededAt(runs, *row)) rows.push_back(row);
  }
  return rows;
}

std::string verdictText(const OrderFit& fit, double theory) {
  if (!fit.measurable) return "not_measurable";
  if (std::isnan(theory)) return "no_theory";
  return std::abs(fit.order - theory) <= kAgreement ? "agrees" : "differs";
}

TableRow orderRow(TableRow row, char component, const OrderFit& fit, double theory) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  row.emplace_back(1, component);
  for (const double x : {fit.order, fit.confidence, fit.h_min, fit.h_max}) {
    row.push_back(numberText(fit.measurable ? x : unknown));
  }
  row.push_back(std::to_string(fit.points));
  row.push_back(numberText(theory));
  row.push_back(verdictText(fit, theory));
  row.push_back(fit.reason);
  return row;
}

void appendOrders(const Table& runs, const std::vector<const TableRow*>& series, Table& orders) {
  const TableRow& first = *series.front();
  const auto kind = kindOf(textAt(runs, first, "scene"), textAt(runs, first, "formulation"));
  OrderFitOptions options;
  // Round-off of errors that are computed in 50 digits.
  if (textAt(runs, first, "scalar") == "mp50") options.floor = 50 * 1e-50;
  for (const char component : {'u', 'v', 'x', 'z'}) {
    const std::string column = std::string("error_") + component;
    std::vector<ErrorPoint> points;
    bool known = false;
    for (const auto* row : series) {
      points.push_back({numberAt(runs, *row, "h"), numberAt(runs, *row, column)});
      known = known || !std::isnan(points.back().error);
    }
    if (!known) continue;
    const TableRow start{textAt(runs, first, "scene"), textAt(runs, first, "settings"),
                         textAt(runs, first, "formulation"), textAt(runs, first, "family"),
                         textAt(runs, first, "stages")};
    OrderFit fit = fitOrder(points, options);
    const double theory = theoryFor(runs, first, component);
    // What theory says about components of algebraic systems is a bound for all of them.
    const bool better = fit.measurable && fit.order > theory + kAgreement;
    if (better && kind != SystemKind::kOde) {
      fit.reason = "higher than the general result: this system does not excite its worst term";
    }
    orders.rows.push_back(orderRow(start, component, fit, theory));
  }
}

}  // namespace

// A user's method has the order that its tableau declares, for ordinary differential equations.
double theoryFor(const Table& runs, const TableRow& row, char component) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto kind = kindOf(textAt(runs, row, "scene"), textAt(runs, row, "formulation"));
  if (!kind) return unknown;
  const auto& family = textAt(runs, row, "family");
  const auto stages = static_cast<Index>(numberAt(runs, row, "stages"));
  const auto order = theoreticalOrder(family, stages, *kind, component);
  if (order || *kind != SystemKind::kOde) return order.value_or(unknown);
  try {
    return makeTableau<double>(textAt(runs, row, "method")).order;
  } catch (const Misuse&) {  // the file is no longer there
    return unknown;
  }
}

Table orderTable(const Table& runs) {
  Table orders;
  orders.head = runs.head;
  orders.columns = {"scene",     "settings", "formulation", "family", "stages",
                    "component", "order",    "confidence",  "h_min",  "h_max",
                    "points",    "theory",   "verdict",     "reason"};
  for (const auto& series : seriesOf(runs)) {
    const bool fixed = textAt(runs, *series.rows.front(), "control") == "fixed";
    const auto rows = successes(runs, series);
    if (fixed && !rows.empty()) appendOrders(runs, rows, orders);
  }
  return orders;
}

}  // namespace irk
