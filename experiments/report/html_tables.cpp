#include "experiments/report/html_tables.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "experiments/base/html.h"
#include "experiments/runs/run_table.h"

namespace irk {
namespace {

std::string cell(std::string_view text) { return fmt::format("<td>{}</td>", escapeHtml(text)); }

std::string numberCell(const Table& table, const TableRow& row, std::string_view column, int digits) {
  const double x = numberAt(table, row, column);
  return std::isnan(x) ? "<td>–</td>" : fmt::format("<td>{:.{}g}</td>", x, digits);
}

}  // namespace

std::string ordersHtml(const std::string& study, const Table& orders) {
  std::string html = fmt::format("<table><caption>Study {}</caption><thead><tr>", study);
  for (const auto* title : {"scene", "formulation", "method", "component", "power of", "order", "± (95 %)", "theory",
                            "source", "verdict", "window", "points", "reason"}) {
    html += fmt::format("<th>{}</th>", title);
  }
  html += "</tr></thead><tbody>\n";
  for (const auto& row : orders.rows) {
    const auto text = [&](std::string_view name) { return textAt(orders, row, name); };
    html += fmt::format("<tr class=\"{}\">", text("verdict"));
    const auto settings = text("settings");
    html += cell(text("scene") + (settings.empty() ? "" : " " + settings));
    for (const auto* name : {"formulation", "method", "component", "power_of"}) {
      html += cell(text(name));
    }
    html += numberCell(orders, row, "order", 4) + numberCell(orders, row, "confidence", 1);
    html += numberCell(orders, row, "theory", 4) + cell(text("source"));
    html += cell(text("verdict"));
    const bool measured = !std::isnan(numberAt(orders, row, "order"));
    html += measured
                ? cell(fmt::format("{:.3g} … {:.3g}", numberAt(orders, row, "h_min"), numberAt(orders, row, "h_max")))
                : cell("–");
    html += cell(text("points")) + cell(text("reason"));
    html += "</tr>\n";
  }
  return html + "</tbody></table>\n";
}

std::string tableausHtml(const Table& tableaus) {
  struct Column {
    const char *name, *title;
    int digits;  ///< 0: yes or no
  };
  constexpr Column kColumns[] = {{"order", "order", 4},
                                 {"C", "stage order", 4},
                                 {"numerator_degree", "deg N", 4},
                                 {"denominator_degree", "deg D", 4},
                                 {"R_infinity", "R(∞)", 4},
                                 {"error_constant", "error constant", 3},
                                 {"a_stable", "A-stable", 0},
                                 {"l_stable", "L-stable", 0},
                                 {"algebraically_stable", "algebraically stable", 0},
                                 {"symplectic", "symplectic", 0},
                                 {"symmetric", "symmetric", 0},
                                 {"condition_A", "cond A", 3},
                                 {"condition_eigenvectors", "cond eigenvectors", 3}};
  std::string html = "<table><thead><tr><th>method</th>";
  for (const auto& column : kColumns) html += fmt::format("<th>{}</th>", column.title);
  html += "</tr></thead><tbody>\n";
  for (const auto& row : tableaus.rows) {
    html += "<tr>" + cell(textAt(tableaus, row, "method"));
    for (const auto& [name, title, digits] : kColumns) {
      html +=
          digits > 0 ? numberCell(tableaus, row, name, digits) : cell(numberAt(tableaus, row, name) > 0 ? "yes" : "no");
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table>\n";
}

std::string environmentHtml(const std::string& study, const Table& runs) {
  std::map<std::string, int> outcomes;
  for (const auto& row : runs.rows) ++outcomes[textAt(runs, row, "outcome")];
  std::string ended;
  for (const auto& [outcome, count] : outcomes) {
    if (!ended.empty()) ended += ", ";
    ended += fmt::format("{} {}", count, outcome);
  }
  std::string html = fmt::format("<table><caption>Study {}</caption><tbody>\n", study);
  for (const auto& [key, value] : runs.head) {
    html += fmt::format("<tr><th>{}</th>{}</tr>\n", escapeHtml(key), cell(value));
  }
  return html + fmt::format("<tr><th>runs</th>{}</tr>\n</tbody></table>\n", cell(ended));
}

}  // namespace irk
