// The tables that claims are judged by.
#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "experiments/tables/table.h"

namespace irk::claims {

/// Thrown if a study's results are missing, or if their times come from several processors and are not joined. It is no
/// misuse: the claim is then `not measurable`.
class MissingResults : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// results/<study>/<name>.csv, each read once, when it is asked for.
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

 private:
  std::filesystem::path results_;
  mutable std::map<std::string, Table> tables_;  // by study/name
};

}  // namespace irk::claims
