// What a study can have computed from its runs: a catalogue. A new analysis is a file of its own and a line in
// analyses.cpp; the reader of studies, `irk run` and `irk list analyses` take it from there.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/tables/table.h"

namespace irk {

struct Study;

/// What an analysis works with. The references are valid while it runs.
struct AnalysisInput {
  const Study& study;
  const Table& runs;                    ///< of runs.csv
  const std::filesystem::path& folder;  ///< results/<study>
  std::ostream& progress;
};

struct Analysis {
  std::string_view id;
  /// A study asks for it by `key = true`, or by naming errors: `targets = [1e-4, 1e-6]`.
  std::string_view key;
  std::string_view meaning;  ///< one line
  std::string_view reads;    ///< files of results/<study>
  std::string_view writes;   ///< the same, separated by blanks
  /// Why it takes runs of one method each, and none of variable order; empty where it takes both.
  std::string_view one_method = {};
  /// Another key of the study without which it has nothing to read; empty: none.
  std::string_view needs = {};
  /// Writes its files. Returns one line for every number that must not be believed.
  std::vector<std::string> (*run)(const AnalysisInput&);
};

/// In the order in which they are run: one may read what those before it write.
std::span<const Analysis> analyses();

}  // namespace irk
