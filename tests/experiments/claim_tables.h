// Made-up results with known verdicts.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/claims/claims.h"
#include "experiments/claims/measures.h"

namespace irk::claims {

inline const Part& partOf(std::string_view id) {
  for (const auto& claim : protocol().claims) {
    for (const auto& part : claim.parts) {
      if (part.id == id) return part;
    }
  }
  throw std::runtime_error("no part " + std::string(id));
}

inline Finding finding(std::string_view id, const ResultTables& tables, Setting setting = Setting::kPaper) {
  return findingOn(partOf(id), setting, tables, protocol().multibody);
}
inline Verdict verdict(std::string_view id, const ResultTables& tables, Setting setting = Setting::kPaper) {
  return finding(id, tables, setting).judged.verdict;
}

inline constexpr Verdict kYes = Verdict::kConfirmed, kNo = Verdict::kContradicted, kOpen = Verdict::kUndecided,
                         kUnknown = Verdict::kNotMeasurable;

inline const ResultTables kNoResults;

/// Multibody systems, as most claims want them.
inline const std::vector<std::string> kScenes = {"pendulum", "slider_crank", "ancf_pendulum"};

using Row = std::map<std::string, std::string>;

inline std::string text(double x) { return fmt::format("{}", x); }

/// Results that consist of this table.
inline ResultTables resultsOf(const char* study, const char* name, const Table& table) {
  ResultTables results;
  results.put(study, name, table);
  return results;
}

/// A table of the study claims with every column that an evaluation reads. Cells that a row does not give are those of
/// a successful run in the paper's setting.
class RunTable {
 public:
  RunTable() {
    for (const auto& [column, cell] : defaults()) table_.columns.push_back(column);
  }
  /// A row that gives a family has a method of that family and number of stages.
  void add(Row cells) {
    if (cells.contains("family") && !cells.contains("method")) {
      cells["method"] = cells["family"] + "_" + (cells.contains("stages") ? cells["stages"] : "3");
    }
    TableRow row;
    for (const auto& [column, cell] : defaults()) {
      const auto given = cells.find(column);
      row.push_back(given == cells.end() ? cell : given->second);
    }
    table_.rows.push_back(std::move(row));
  }
  /// The same at ten reference times.
  void addTimes(Row cells) {
    for (int i = 1; i <= kReferenceTimes; ++i) {
      cells["t_end"] = std::to_string(i);
      add(cells);
    }
  }
  /// A series of runs with all costs = scale * error^(-1/4), at ten reference times.
  void addSeries(Row cells, double scale) {
    for (const double error : {1e-2, 1e-4, 1e-6, 1e-8, 1e-11}) {
      cells["rtol"] = text(error);
      for (const char* column : {"error", "error_u", "error_v", "error_z"}) cells[column] = text(error);
      for (const char* column : {"cpu_s", "newton_iterations", "jacobians"})
        cells[column] = text(scale * std::pow(error, -0.25));
      addTimes(cells);
    }
  }
  const Table& table() const { return table_; }
  ResultTables results() const { return resultsOf("claims", "runs", table_); }

 private:
  static const Row& defaults() {
    static const Row kDefaults = {{"scene", "pendulum"},
                                  {"settings", ""},
                                  {"configuration", "paper"},
                                  {"method", "radau_iia_3"},
                                  {"family", "radau_iia"},
                                  {"stages", "3"},
                                  {"control", "paper"},
                                  {"newton", "modified"},
                                  {"jacobian", "full"},
                                  {"norm", "absolute"},
                                  {"formulation", "index2"},
                                  {"scaling", "on"},
                                  {"contractivity_limit", "0.7"},
                                  {"contractivity_after", "3"},
                                  {"max_iterations", "25"},
                                  {"residual_tolerance", "1e-10"},
                                  {"rtol", "1e-6"},
                                  {"t_end", "1"},
                                  {"outcome", "success"},
                                  {"error", "nan"},
                                  {"error_u", "nan"},
                                  {"error_v", "nan"},
                                  {"error_z", "nan"},
                                  {"drift", "nan"},
                                  {"cpu_s", "1"},
                                  {"newton_iterations", "1"},
                                  {"residuals", "1"},
                                  {"dual_residuals", "0"},
                                  {"mass_factorizations", "0"},
                                  {"jacobians", "1"},
                                  {"steps_accepted", "1"},
                                  {"steps_rejected_error", "0"},
                                  {"steps_rejected_newton", "0"},
                                  {"newton_restarts", "0"},
                                  {"located_events", "0"},
                                  {"detail", ""},
                                  {"block", ""}};
    return kDefaults;
  }

  Table table_;
};

}  // namespace irk::claims
