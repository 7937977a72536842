// The catalogue of analyses: tables that a study can request from its runs. A new analysis is a file of its own and a
// line in analyses.cpp; the study reader, `irk run` and `irk list analyses` then include it.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace irk {

class RunFile;  // experiments/analyses/run_file.h
struct Study;

/// The input of an analysis. The references are valid while it runs.
struct AnalysisInput {
  const Study& study;
  const RunFile& runs;
  const std::filesystem::path& folder;  ///< results/<study>
  std::ostream& progress;
};

struct Analysis {
  /// The key of a study file that requests it: `key = true`, or a list of errors, `targets = [1e-4, 1e-6]`.
  std::string_view key;
  std::string_view id = key;            ///< its name in lists
  std::string_view meaning;             ///< one line
  std::string_view reads = "runs.csv";  ///< files of results/<study>
  std::string_view writes;              ///< the same, separated by blanks
  /// The reason why it requires runs of one method each and refuses variable order; empty if it accepts both.
  std::string_view one_method = {};
  /// Another key of the study that this analysis requires; empty if none.
  std::string_view needs = {};
  /// Writes the files.
  void (*run)(const AnalysisInput&);
};

/// In the order of execution: an analysis may read the files of those before it.
std::span<const Analysis> analyses();

}  // namespace irk
