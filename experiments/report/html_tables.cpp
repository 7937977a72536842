#include "experiments/report/html_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "experiments/runs/run_table.h"
#include "experiments/tables/table_rows.h"

namespace irk {
namespace {

std::string numberText(const Table& table, const TableRow& row, std::string_view column, int digits) {
  const double x = numberAt(table, row, column);
  return std::isnan(x) ? "–" : fmt::format("{:.{}g}", x, digits);
}

// The properties of an environment in the table: a column of environments.csv and its title.
constexpr std::pair<const char*, const char*> kProperties[] = {
    {"cpu", "processor"},     {"cores", "cores"}, {"memory_gb", "memory in GB"}, {"libraries", "system and libraries"},
    {"compiler", "compiler"}, {"flags", "flags"}, {"version", "version"},        {"commit", "commit"},
    {"host", "host"}};

}  // namespace

HtmlTable ordersHtml(const Table& orders) {
  HtmlTable html{.caption = "Observed orders and theory",
                 .titles = {"scene", "formulation", "method", "component", "power of", "order", "± (95 %)", "theory",
                            "source", "verdict", "window", "points", "reason"}};
  for (const auto& row : orders.rows) {
    const auto text = [&](std::string_view name) { return escapeHtml(textAt(orders, row, name)); };
    const auto number = [&](std::string_view name, int digits) { return numberText(orders, row, name, digits); };
    const auto settings = text("settings");
    const bool measured = !std::isnan(numberAt(orders, row, "order"));
    html.rows.push_back(
        {{text("scene") + (settings.empty() ? "" : " " + settings), text("formulation"), text("method"),
          text("component"), text("power_of"), number("order", 4), number("confidence", 1), number("theory", 4),
          text("source"), text("verdict"), measured ? number("h_min", 3) + "&nbsp;…&nbsp;" + number("h_max", 3) : "–",
          text("points"), text("reason")},
         textAt(orders, row, "verdict")});
  }
  return html;
}

HtmlTable tableausHtml(const Table& tableaus) {
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
  HtmlTable html{.caption = "All families, 1 to 20 stages", .titles = {"method"}};
  for (const auto& column : kColumns) html.titles.emplace_back(column.title);
  for (const auto& row : tableaus.rows) {
    HtmlTable::Row cells{{escapeHtml(textAt(tableaus, row, "method"))}};
    for (const auto& [name, title, digits] : kColumns) {
      const bool number = digits > 0;
      cells.cells.push_back(number                              ? numberText(tableaus, row, name, digits)
                            : numberAt(tableaus, row, name) > 0 ? "yes"
                                                                : "no");
    }
    html.rows.push_back(std::move(cells));
  }
  return html;
}

std::set<std::string> usedEnvironments(const std::filesystem::path& runs) {
  std::set<std::string> used;
  forEachRow(runs, [&used](const Table& names, const TableRow& row) {
    for (const char* column : {"environment", "cpu_environment"}) {
      if (names.hasColumn(column)) used.insert(textAt(names, row, column));
    }
  });
  return used;
}

void Environments::add(const std::string& study, const Table& environments, const std::set<std::string>& used) {
  for (const auto& row : environments.rows) {
    if (!used.contains(textAt(environments, row, "environment"))) continue;
    Environment found;
    for (const auto& [column, title] : kProperties) {
      found.values.push_back(environments.hasColumn(column) ? textAt(environments, row, column) : "");
    }
    auto at = std::find_if(all_.begin(), all_.end(), [&](const Environment& e) { return e.values == found.values; });
    if (at == all_.end()) at = all_.insert(at, std::move(found));
    at->studies.insert(study);
  }
}

HtmlTable Environments::table() const {
  HtmlTable html{.caption = "Where the runs were made", .titles = {"property"}};
  for (std::size_t i = 0; i < all_.size(); ++i) {
    html.titles.push_back(all_.size() == 1 ? "value" : fmt::format("environment {}", i + 1));
  }
  if (all_.empty()) return html;
  for (std::size_t k = 0; k < std::size(kProperties); ++k) {
    HtmlTable::Row row{{kProperties[k].second}};
    for (const auto& one : all_) row.cells.push_back(one.values[k].empty() ? "–" : escapeHtml(one.values[k]));
    html.rows.push_back(std::move(row));
  }
  HtmlTable::Row studies{{"studies"}};
  for (const auto& one : all_) studies.cells.push_back(escapeHtml(fmt::format("{}", fmt::join(one.studies, ", "))));
  html.rows.push_back(std::move(studies));
  return html;
}

}  // namespace irk
