#include "experiments/report/answers/order_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "experiments/analyses/orders/row_theory.h"
#include "experiments/base/numbers.h"
#include "experiments/report/answers/formula.h"
#include "experiments/runs/run_table.h"

namespace irk::report {
namespace {

constexpr const char* kStudy = "order";

struct Family {
  const char *id, *title;
};
constexpr Family kFamilies[] = {{"gauss", "Gauss"},
                                {"radau_ia", "Radau IA"},
                                {"radau_iia", "Radau IIA"},
                                {"lobatto_iiia", "Lobatto IIIA"},
                                {"lobatto_iiib", "Lobatto IIIB"},
                                {"lobatto_iiic", "Lobatto IIIC"},
                                {"lobatto_iiics", "Lobatto IIIC*"},
                                {"lobatto_iiid", "Lobatto IIID"}};

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

// One line for each case of the formula.
std::string cellHtml(const OrderFormula& formula, const OrderCheck& check) {
  std::string lines = escapeHtml(formula.text);
  replacePlaceholder(lines, "; ", "<br>");
  std::string html = fmt::format("<span class=\"formula\">{}{}</span>", lines, formula.theorem ? "" : "&#8224;");
  const int measured = check.agree + check.differ;
  if (measured == 0) return html;
  return html + fmt::format(" <span class=\"{}\">{} {}/{}</span>", check.differ > 0 ? "differ" : "agree",
                            check.differ > 0 ? "✗" : "✓", check.agree, measured);
}

void appendRow(const System& system, char component, const std::map<Place, OrderCheck>& checks, Answer& answer) {
  HtmlTable::Row shown{{escapeHtml(system.title), componentTitle(component)}};
  for (const auto& family : kFamilies) {
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

std::vector<std::string> titlesOf(const std::vector<const Family*>& families) {
  std::vector<std::string> titles;
  for (const auto* family : families) titles.emplace_back(family->title);
  return titles;
}

// Which families keep the order of ODEs in the differential unknowns of index 2.
std::string keptSentence() {
  std::vector<const Family*> kept, lost;
  for (const auto& family : kFamilies) {
    const auto ode = orderFormula(family.id, SystemKind::kOde, 'x');
    const auto index2 = orderFormula(family.id, SystemKind::kIndex2, 'x');
    if (ode && index2) (ode->text == index2->text ? kept : lost).push_back(&family);
  }
  return fmt::format(
      "With constraints (index 2) the differential unknowns keep the order of ODEs with {}, and lose order with {}.",
      listText(titlesOf(kept)), listText(titlesOf(lost)));
}

}  // namespace

void add(const Table& orders, const TableRow& row, OrderCheck& check) {
  const auto& verdict = textAt(orders, row, "verdict");
  if (verdict == "not_measurable") ++check.not_measurable;
  if (verdict == "no_theory") ++check.no_theory;
  if (verdict != "agrees" && verdict != "differs") return;
  ++(verdict == "agrees" ? check.agree : check.differ);
  check.worst = std::fmax(check.worst, std::abs(numberAt(orders, row, "order") - numberAt(orders, row, "theory")));
}

OrderCheck checkOf(const Table& orders) {
  OrderCheck check;
  for (const auto& row : orders.rows) add(orders, row, check);
  return check;
}

std::string sentenceOf(const OrderCheck& check) {
  const int measured = check.agree + check.differ;
  if (measured == 0) return "No order could be measured.";
  std::string text = fmt::format("{} of {} measured orders agree with theory; the largest difference is {:.2g}",
                                 check.agree, measured, check.worst);
  if (check.not_measurable > 0) text += fmt::format("; {} more series are not measurable", check.not_measurable);
  if (check.no_theory > 0) text += fmt::format("; for {} theory knows no order", check.no_theory);
  return text + ".";
}

Answer orderAnswer(const claims::ResultTables& tables) {
  Answer answer{.id = "orders",
                .question = "Which order does each component have?",
                .sentences = {},
                .table = {{},
                          {"system", "component", "family", "formula", "source", "agree", "differ", "not_measurable",
                           "largest_difference"},
                          {}},
                .shown = {.caption = "Order of convergence with s stages",
                          .titles = {"system", "component"},
                          .css_class = "formulas"},
                .more = {.caption = "Other systems: general index 2 and 3, projected index 2, GGL, stiff with fixed hλ",
                         .titles = {"system", "component"},
                         .css_class = "formulas"}};
  std::map<Place, OrderCheck> checks;
  try {
    const Table& orders = tables.table(kStudy, "orders");
    answer.table.head = orders.head;
    checks = checksOf(orders);
    answer.sentences.push_back(sentenceOf(checkOf(orders)));
    answer.links = {{"#order_table", "every measured order"}, {"#study_order", "diagrams"}};
  } catch (const claims::MissingResults&) {
    answer.sentences.push_back("Not checked yet: `irk run order` measures the orders.");
  }
  answer.sentences.push_back(keptSentence());
  for (auto* table : {&answer.shown, &answer.more}) {
    for (const auto& family : kFamilies) table->titles.emplace_back(family.title);
  }
  for (const auto& system : kSystems) {
    for (const char component : std::string_view(system.components)) appendRow(system, component, checks, answer);
  }
  answer.note =
      "✓ 5/5: measured orders that agree with the formula, of all that are measurable. † a pattern measured for up to "
      "5 stages and continued, no theorem. Lobatto families begin with s = 2. In index 3, x are the velocities of "
      "y'' = …; GGL: Gear, Gupta and Leimkuhler; projected: one projection of the velocities per step. –: no theory, "
      "or "
      "the family cannot treat algebraic unknowns.";
  return answer;
}

}  // namespace irk::report
