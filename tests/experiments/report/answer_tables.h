// Tables of results, made for tests of answers.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/tables/table.h"

namespace irk::report {

using Cells = std::map<std::string, std::string>;

inline Table tableOf(const std::vector<std::string>& columns, const std::vector<Cells>& rows) {
  Table table{{{"study", "made_up"}}, columns, {}};
  for (const auto& cells : rows) {
    TableRow row;
    for (const auto& column : columns) row.push_back(cells.contains(column) ? cells.at(column) : "");
    table.rows.push_back(std::move(row));
  }
  return table;
}

inline std::string cell(const Table& table, std::size_t row, std::string_view column) {
  return table.rows.at(row).at(table.column(column));
}

}  // namespace irk::report
