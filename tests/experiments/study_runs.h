// Small studies for single tests.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/runner/runner.h"
#include "experiments/runner/skipped_runs.h"
#include "experiments/store/checksum.h"
#include "experiments/store/store.h"
#include "experiments/study/study_reader.h"
#include "experiments/tables/table.h"
#include "tests/experiments/support.h"

namespace irk {

/// Makes the runs on this process alone, exports the tables and returns runs.csv.
inline Table runStudy(const Study& study, const RunnerOptions& options, std::ostream& progress) {
  store::Store store(studyFolder(study, options), study.id, store::Use::kWrite, options.store, progress);
  const auto alone = aloneRank();
  const auto keys = makeRuns(study, options, store, *alone, progress);
  recordSkippedRuns(study, keys, store);
  store.exportTables(keys);
  return readTable(store.folder() / "runs.csv");
}

struct StudyRuns {
  Study study;
  Table runs;
};

/// The study of a TOML text and its runs, made with two threads in a temporary folder.
inline StudyRuns runsOf(std::string_view toml) {
  const TemporaryFolder folder;
  RunnerOptions options;
  options.results = folder.path();
  options.jobs = 2;
  std::ostringstream quiet;
  StudyRuns made{parseStudy(toml, "small.toml", StudyVariant::kFull), {}};
  made.runs = runStudy(made.study, options, quiet);
  return made;
}

/// The part files of a study's folder whose names begin with `table`, sorted.
inline std::vector<std::filesystem::path> partsOf(const std::filesystem::path& folder,
                                                  std::string_view table = "runs") {
  std::vector<std::filesystem::path> parts;
  if (!std::filesystem::is_directory(folder / "parts")) return parts;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "parts")) {
    const auto name = entry.path().filename().string();
    if (name.starts_with(table) && name.ends_with(".csv")) parts.push_back(entry.path());
  }
  std::sort(parts.begin(), parts.end());
  return parts;
}

/// The number of complete rows in the parts, without the lines of column names.
inline std::ptrdiff_t rowsInParts(const std::filesystem::path& folder) {
  std::ptrdiff_t rows = 0;
  for (const auto& part : partsOf(folder)) {
    const std::string text = readInputFile(part);
    rows += std::max<std::ptrdiff_t>(std::count(text.begin(), text.end(), '\n') - 1, 0);
  }
  return rows;
}

/// The rows of a part, without their checksums.
inline Table readPartTable(const std::filesystem::path& part) {
  Table table = readTable(part);
  table.columns.pop_back();
  for (auto& row : table.rows) row.pop_back();
  return table;
}

/// Writes a part whose checksums are right.
inline void writePartTable(const std::filesystem::path& part, const Table& table) {
  std::filesystem::create_directories(part.parent_path());
  std::ofstream out(part, std::ios::binary);
  out << store::sealedNames(csvLine(table.columns)) << '\n';
  for (const auto& row : table.rows) out << store::sealedRow(csvLine(row)) << '\n';
}

}  // namespace irk
