// The tables that claims are judged by.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "experiments/tables/grouped_file.h"
#include "experiments/tables/table.h"

namespace irk::claims {

/// Thrown if a study's results are missing, or if their times come from several processors and are not joined. It is no
/// misuse: the claim is then `not measurable`.
class MissingResults : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// results/<study>/<name>.csv. Whole tables are read once, when they are asked for, and kept.
class ResultTables {
 public:
  explicit ResultTables(std::filesystem::path results = {}) : results_(std::move(results)) {}

  /// Whether these are results of --quick, which are kept in a folder of this name.
  bool areQuick() const { return results_.filename() == "quick"; }

  /// Adds a table that is not in a file.
  void put(const std::string& study, const std::string& name, Table table);

  /// The table runs.csv of a study. Throws MissingResults.
  const Table& runs(std::string_view study) const { return table(study, "runs"); }
  const Table& table(std::string_view study, std::string_view name) const;
  /// Calls `take` for the runs of a study, in their order, whose cell of blocks the test accepts, and keeps none of
  /// them. `names` has the head and the columns, and no rows; it is returned, too. Throws MissingResults, and Misuse
  /// for a table without the column of blocks.
  Table forEachRun(std::string_view study, const std::function<bool(const std::string& blocks)>& wanted,
                   const std::function<void(const Table& names, TableRow row)>& take) const;

 private:
  std::filesystem::path fileOf(std::string_view study, std::string_view name) const;

  std::filesystem::path results_;
  mutable std::map<std::string, Table> tables_;                        // by study/name
  mutable std::map<std::string, std::shared_ptr<GroupedFile>> files_;  // runs by blocks, by study
};

}  // namespace irk::claims
