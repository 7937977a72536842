// The part of a table of runs that a figure draws. gnuplot reads a table once for every curve: with all columns a
// figure of 1e4 rows takes a minute, and one of 1e6 rows takes hours.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "experiments/base/folders.h"
#include "experiments/report/figure_list.h"

namespace irk {

/// The options that the assignments NAME='TEXT', NAME="TEXT" and NAME=NUMBER of a figure give, by their names.
std::map<std::string, std::string> optionsOf(const std::string& assignments);

/// A folder of temporary files; the destructor removes it.
class DrawnRows {
 public:
  /// Links all files of `results` but runs.csv. Of runs.csv it writes the rows and columns that `figure` draws: the
  /// rows of its block, scene, cases and `only`, and the columns that its script names. If more than kMostRows are left
  /// and the script has a line `# Thins by OPTION COLUMN ...`, a mark is left out if another mark of the same curve,
  /// with the same outcome, lies within a small part of a decade in these columns; the part grows until kMostRows are
  /// left. Throws Failure, Misuse.
  DrawnRows(const Figure& figure, const std::filesystem::path& home, const std::filesystem::path& results);

  const std::filesystem::path& folder() const { return folder_.path(); }
  std::size_t rows() const { return rows_; }

  /// Smaller tables are read by gnuplot as they are.
  static constexpr std::uintmax_t kLargeFile = 300'000;  // bytes; about 500 rows
  static constexpr std::size_t kMostRows = 20'000;

 private:
  ScratchFolder folder_;
  std::size_t rows_ = 0;
};

/// The folder from which the figure is drawn if its script reads runs.csv and that is large; else nullptr.
std::unique_ptr<DrawnRows> drawnRows(const Figure& figure, const ReportOptions& options);

}  // namespace irk
