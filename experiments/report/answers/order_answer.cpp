#include "experiments/report/answers/order_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "experiments/analyses/orders/row_theory.h"
#include "experiments/base/numbers.h"
#include "experiments/report/answers/formula.h"
#include "experiments/runs/run_table.h"
#include "irk/tableaus.h"

namespace irk::report {
namespace {

constexpr const char* kOrderStudy = "order";

struct System {
  SystemKind kind;
  const char *id, *title, *components;
  bool important = false;  ///< shown at once; the others are folded
};
constexpr System kSystems[] = {
    {SystemKind::kOde, "ode", "ODE", "x", true},
    {SystemKind::kIndex1, "index1", "index 1", "xz", true},
    {SystemKind::kIndex2, "index2", "index 2", "xz"},
    {SystemKind::kIndex3, "index3", "index 3", "xz"},
    {SystemKind::kMechanical3, "mechanical_index3", "mechanical, index 3", "uvz", true},
    {SystemKind::kMechanical2, "mechanical_index2", "mechanical, index 2", "uvz", true},
    {SystemKind::kProjected, "mechanical_index2_projected", "mechanical, index 2 projected", "uvz"},
    {SystemKind::kGgl, "mechanical_ggl", "mechanical, GGL", "uvz"},
    {SystemKind::kStiffFixedLambda, "stiff", "stiff, fixed λ → −∞", "x", true},
    {SystemKind::kStiffFixedZ, "stiff_fixed_z", "stiff, fixed hλ → −∞", "x"}};

const char* componentTitle(char component) {
  return component == 'u' ? "position" : component == 'v' ? "velocity" : component == 'z' ? "z, multiplier" : "x";
}

using Place = std::tuple<SystemKind, char, std::string>;  // kind, component, family

// The checks of all cells.
std::map<Place, OrderCheck> checksOf(const Table& orders) {
  std::map<Place, OrderCheck> checks;
  for (const auto& row : orders.rows) {
    if (textAt(orders, row, "power_of") != "h") continue;
    const auto kind = kindOf(orders, row, numberAt(orders, row, "h_min"));
    if (!kind) continue;
    add(orders, row, checks[{*kind, textAt(orders, row, "component").front(), textAt(orders, row, "family")}]);
  }
  return checks;
}

// How many measured orders agree: `✓ 5/5`; `✗ 4/5, s = 15: 15.54 instead of 15`; `✓ 8/8, 5 not measurable`.
std::string checkText(const OrderCheck& check) {
  const int measured = check.agree + check.differ;
  std::string text = fmt::format("{} {}/{}", check.differ > 0 ? "✗" : "✓", check.agree, measured);
  for (const auto& [stages, order] : check.differing) text += fmt::format(", s = {}: {}", stages, order);
  if (check.not_measurable > 0) text += fmt::format(", {} not measurable", check.not_measurable);
  return text;
}

// One line for each case of the formula.
std::string cellHtml(const OrderFormula& formula, const OrderCheck& check) {
  std::string lines = escapeHtml(formula.text);
  replacePlaceholder(lines, "; ", "<br>");
  std::string html = fmt::format("<span class=\"formula\">{}{}</span>", lines, formula.theorem ? "" : "&#8224;");
  if (formula.divergent > 0)
    html += fmt::format(" <span class=\"differ\">no convergence for s ≤ {}</span>", formula.divergent);
  if (check.agree + check.differ == 0) return html;
  return html + fmt::format(" <span class=\"{}\">{}</span>", check.differ > 0 ? "differ" : "agree", checkText(check));
}

void appendRow(const System& system, char component, const std::map<Place, OrderCheck>& checks, Answer& answer) {
  HtmlTable::Row shown{{escapeHtml(system.title), componentTitle(component)}};
  for (const auto& family : familyCatalogue()) {
    const auto formula = orderFormula(family.id, system.kind, component);
    const auto found = checks.find({system.kind, component, family.id});
    const OrderCheck check = found == checks.end() ? OrderCheck{} : found->second;
    shown.cells.push_back(formula ? cellHtml(*formula, check) : "–");
    if (!formula) continue;
    answer.table.rows.push_back({system.id, std::string(1, component), family.id, formula->text,
                                 formula->theorem ? "theorem" : "pattern", std::to_string(check.agree),
                                 std::to_string(check.differ), std::to_string(check.not_measurable),
                                 numberText(check.worst)});
  }
  (system.important ? answer.shown : answer.more).rows.push_back(std::move(shown));
}

// Which families keep the order of ODEs in the positions and velocities of a mechanical system of index 2.
std::string keptSentence() {
  std::vector<std::string> both, positions, neither;
  for (const auto& family : familyCatalogue()) {
    const auto formula = [&](SystemKind kind, char component) { return orderFormula(family.id, kind, component); };
    const auto ode = formula(SystemKind::kOde, 'x');
    const auto u = formula(SystemKind::kMechanical2, 'u'), v = formula(SystemKind::kMechanical2, 'v');
    if (!ode || !u || !v) continue;
    (u->text != ode->text ? neither : v->text != ode->text ? positions : both).push_back(family.title);
  }
  std::string text = fmt::format(
      "With constraints (mechanical, index 2) positions and velocities keep the order of "
      "ODEs with {}",
      listText(both));
  if (!positions.empty()) text += fmt::format("; only the positions keep it with {}", listText(positions));
  if (!neither.empty()) text += fmt::format("; both lose order with {}", listText(neither));
  return text + ".";
}

// Where measured orders and theory differ; empty if they do not.
std::string differSentence(const Table& orders) {
  std::set<int> stages;
  double measured = 0, least = std::numeric_limits<double>::infinity();
  for (const auto& row : orders.rows) {
    if (textAt(orders, row, "verdict") != "differs") continue;
    stages.insert(static_cast<int>(numberAt(orders, row, "stages")));
    const double difference = std::abs(numberAt(orders, row, "order") - numberAt(orders, row, "theory"));
    measured = std::max(measured, difference);
    least = std::min(least, difference);
  }
  if (stages.empty()) return {};
  std::vector<std::string> names;
  for (const int s : stages) names.push_back(std::to_string(s));
  return fmt::format("Those that differ have s = {} and lie {:.2g} to {:.2g} from theory.", listText(names), least,
                     measured);
}

}  // namespace

void add(const Table& orders, const TableRow& row, OrderCheck& check) {
  const auto& verdict = textAt(orders, row, "verdict");
  if (verdict == "not_measurable") ++check.not_measurable;
  if (verdict == "no_theory") ++check.no_theory;
  if (verdict != "agrees" && verdict != "differs") return;
  const bool agrees = verdict == "agrees";
  ++(agrees ? check.agree : check.differ);
  if (textAt(orders, row, "source") == "theorem") {
    ++check.theorems;
    check.theorems_agree += agrees ? 1 : 0;
  }
  const double order = numberAt(orders, row, "order"), theory = numberAt(orders, row, "theory");
  check.worst = std::fmax(check.worst, std::abs(order - theory));
  if (agrees) return;
  check.differing[static_cast<int>(numberAt(orders, row, "stages"))] =
      fmt::format("{:.4g} instead of {}", order, theory);
}

OrderCheck checkOf(const Table& orders) {
  OrderCheck check;
  for (const auto& row : orders.rows) add(orders, row, check);
  return check;
}

std::string sentenceOf(const OrderCheck& check) {
  const int measured = check.agree + check.differ;
  if (measured == 0) return "No order could be measured.";
  std::string text = fmt::format("{} of {} measured orders agree with theory", check.agree, measured);
  if (check.theorems < measured) {
    text += fmt::format(": {} of {} with theorems, {} of {} with patterns (†) that were measured for up to 5 stages",
                        check.theorems_agree, check.theorems, check.agree - check.theorems_agree,
                        measured - check.theorems);
  }
  text += fmt::format("; the largest difference is {:.2g}", check.worst);
  if (check.not_measurable > 0) text += fmt::format("; {} more series are not measurable", check.not_measurable);
  if (check.no_theory > 0) text += fmt::format("; for {} theory knows no order", check.no_theory);
  return text + ".";
}

Answer orderAnswer(const claims::ResultTables& tables) {
  Answer answer{
      .id = "orders",
      .question = "Which order does each component have?",
      .sentences = {},
      .table = {{},
                {"system", "component", "family", "formula", "source", "agree", "differ", "not_measurable",
                 "largest_difference"},
                {}},
      .shown = {.caption = "Order of convergence with s stages",
                .titles = {"system", "component"},
                .css_class = "formulas"},
      .more = {.caption = "Other systems: general index 2 and 3 (in index 3, x are the velocities of y'' = …), "
                          "index 2 with one projection of the velocities per step, the formulation of Gear, Gupta "
                          "and Leimkuhler (GGL), stiff with fixed hλ",
               .titles = {"system", "component"},
               .css_class = "formulas"}};
  std::map<Place, OrderCheck> checks;
  try {
    const Table& orders = tables.table(kOrderStudy, "orders");
    answer.table.head = orders.head;
    checks = checksOf(orders);
    answer.sentences.push_back(sentenceOf(checkOf(orders)));
    if (auto text = differSentence(orders); !text.empty()) answer.sentences.push_back(std::move(text));
    answer.links = {{"#order_table", "every measured order"}, {"#study_order", "diagrams"}};
  } catch (const claims::MissingResults&) {
    answer.sentences.push_back("Not checked yet: `irk run order` measures the orders.");
  }
  answer.sentences.push_back(keptSentence());
  for (auto* table : {&answer.shown, &answer.more}) {
    for (const auto& family : familyCatalogue()) table->titles.push_back(family.title);
  }
  for (const auto& system : kSystems) {
    for (const char component : std::string_view(system.components)) appendRow(system, component, checks, answer);
  }
  answer.note =
      "✓ 5/5: measured orders that agree with the formula, of all that are measurable; a formula alone: not measured. "
      "The sentences count the orders of all systems, also of systems that have no row here. No convergence: the order "
      "is "
      "zero or less, smaller steps do not improve the component. † a pattern measured for up to 5 stages and "
      "continued, no theorem. Lobatto families begin with s = 2. –: no theory, or the family cannot treat algebraic "
      "unknowns.";
  return answer;
}

}  // namespace irk::report
