// Part files: CSV to which one process appends and which nobody ever rewrites.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/tables/table.h"

namespace irk::store {

/// The cells of one line of CSV as they are written, with their quotes; false for an unbalanced quote or text behind
/// a closing one.
bool splitLine(std::string_view line, std::vector<std::string_view>& cells);
/// A written cell without its quotes.
std::string plainCell(std::string_view written);
TableRow plainRow(const std::vector<std::string_view>& cells);

/// A line that cannot be read: an unbalanced quote, another number of cells, or a last line without its end.
struct DamagedLine {
  std::size_t line;  ///< from 1
  std::string text;
};

struct PartReading {
  bool columns_match = false;  ///< false: written by another version; none of its rows is read
  std::vector<DamagedLine> damaged;
};

/// Calls `take(cells, offset)` for every row, in order; of an exported
/// table the column of blocks is one cell more; `offset`: bytes before the row. Rows are single lines: damage
/// to one never spreads. Throws Failure if the file cannot be read.
PartReading readPart(const std::filesystem::path& file, const std::vector<std::string>& columns,
                     const std::function<bool(const std::vector<std::string_view>& cells,
                                              std::uint64_t offset)>& take);

/// Appends rows to a file of this process' own, which is made with the first one. Each row is one write at the end
/// of the file, so that a killed process leaves whole rows and at most one cut one. Not thread-safe.
class PartWriter {
 public:
  /// `name`.csv; where that exists, `name`_2.csv and so on.
  PartWriter(std::filesystem::path folder, std::string name, std::vector<std::string> columns);
  ~PartWriter();
  PartWriter(const PartWriter&) = delete;
  PartWriter& operator=(const PartWriter&) = delete;

  /// The bytes before the row. Line ends inside cells become blanks. Throws Failure: the disk is full, say; no
  /// row is written behind a cut one.
  std::uint64_t append(const TableRow& row);
  /// Empty before the first row.
  const std::filesystem::path& file() const { return file_; }

 private:
  void open();
  void write(const std::string& text);

  std::filesystem::path folder_, file_;
  std::string name_;
  std::vector<std::string> columns_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  bool failed_ = false;
};

}  // namespace irk::store
