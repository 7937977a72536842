// Rows whose cells stand beside the names of their columns.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/tables/table.h"

namespace irk {

using NamedCells = std::vector<std::pair<std::string, std::string>>;

inline std::vector<std::string> columnsOf(const NamedCells& cells) {
  std::vector<std::string> columns;
  for (const auto& [column, cell] : cells) columns.push_back(column);
  return columns;
}

inline TableRow rowOf(const NamedCells& cells) {
  TableRow row;
  for (const auto& [column, cell] : cells) row.push_back(cell);
  return row;
}

/// Appends a row; the first one names the columns.
inline void addRow(Table& table, const NamedCells& cells) {
  if (table.columns.empty()) table.columns = columnsOf(cells);
  table.rows.push_back(rowOf(cells));
}

}  // namespace irk
