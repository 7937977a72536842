// Final states of a study's runs, beside their rows: states.csv.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/run.h"
#include "experiments/table.h"

namespace irk {

/// u, v, x, z of a scene, one after the other.
Vec<double> componentsOf(const RunRecord& record);

/// Numbers as text, separated by blanks, and back.
std::string vectorText(const Vec<double>& y);
Vec<double> parseVector(const std::string& text);

/// The final states of finished runs by their key. Rows are appended as runs end, so that an
/// interrupt loses none. Not thread-safe.
class FinalStates {
 public:
  /// Takes what a former run of the study left in the file, unless `fresh`.
  FinalStates(const std::filesystem::path& file, const TableHead& head, bool fresh);
  bool has(const std::string& key) const { return states_.contains(key); }
  void append(const std::string& key, const RunRecord& record);

 private:
  std::map<std::string, std::string> states_;
  std::optional<RowWriter> writer_;
};

/// The states of several folders' states.csv in one table.
Table mergedStates(const std::vector<std::string>& folders);

/// The states in a file that FinalStates wrote, by key.
std::map<std::string, Vec<double>> readStates(const std::filesystem::path& file);

}  // namespace irk
