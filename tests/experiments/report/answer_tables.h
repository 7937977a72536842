// Tables of results, made for tests of answers and figures.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/tables/table.h"

namespace irk {

using Cells = std::map<std::string, std::string>;

/// Rows by column; columns that a row does not give get `other`.
inline Table tableOf(const std::vector<std::string>& columns, const std::vector<Cells>& rows,
                     const std::string& other = "", const TableHead& head = {{"study", "made_up"}}) {
  Table table{head, columns, {}};
  for (const auto& cells : rows) {
    TableRow row;
    for (const auto& column : columns) row.push_back(cells.contains(column) ? cells.at(column) : other);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace irk

namespace irk::report {

inline std::string cell(const Table& table, std::size_t row, std::string_view column) {
  return table.rows.at(row).at(table.column(column));
}

}  // namespace irk::report
