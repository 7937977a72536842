// Synthetic results with known verdicts.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "experiments/claims/claims.h"
#include "experiments/claims/measures.h"

namespace irk::claims {

inline const Claim& claim(std::string_view id) {
  for (const auto& one : claims()) {
    if (one.id == id) return one;
  }
  throw std::runtime_error("no claim " + std::string(id));
}

inline Verdict verdict(std::string_view id, const ResultTables& tables) { return judge(claim(id), tables).verdict; }

inline std::string text(double x) { return std::to_string(x); }

/// Adds runs of one method with cost = scale * error^(-1/4); `cells` gives all other columns.
inline void addSeries(Table& table, const std::map<std::string, std::string>& cells, double scale) {
  for (const double error : {1e-2, 1e-4, 1e-6, 1e-8, 1e-11}) {
    TableRow row;
    for (const auto& column : table.columns) {
      const auto given = cells.find(column);
      const double cost = scale * std::pow(error, -0.25);
      if (given != cells.end()) {
        row.push_back(given->second);
      } else if (column == "outcome") {
        row.emplace_back("success");
      } else if (column == "error") {
        row.push_back(fmt::format("{}", error));
      } else {
        row.push_back(fmt::format("{}", cost));  // for every kind of cost
      }
    }
    table.rows.push_back(std::move(row));
  }
}

inline Table costColumns(std::vector<std::string> more) {
  Table table;
  table.columns = std::move(more);
  table.columns.insert(table.columns.end(),
                       {"outcome", "error", "cpu_s", "newton_iterations", "jacobians", "residuals"});
  return table;
}

}  // namespace irk::claims
