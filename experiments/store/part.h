// Part files: CSV files to which one process appends, and which are never rewritten.
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

/// Splits a CSV line into its written cells, quotes included. Returns false for an unbalanced quote or for text
/// behind a closing one.
bool splitLine(std::string_view line, std::vector<std::string_view>& cells);
/// The value of a written cell, without its quotes.
std::string plainCell(std::string_view written);
TableRow plainRow(const std::vector<std::string_view>& cells);

/// A line that cannot be read: an unbalanced quote, a wrong number of cells, or a last line without a line end.
struct DamagedLine {
  std::size_t line;  ///< counts from 1
  std::string text;
};

struct PartReading {
  bool columns_match = false;  ///< false: written by another version; none of its rows are read
  std::vector<DamagedLine> damaged;
};

/// Calls `take(cells, offset)` for every row in order; `offset` is the number of bytes before the row. A table that
/// was exported has one cell more, its blocks. Each row is one line, so damage never spreads to other rows. Throws
/// Failure if the file cannot be read.
PartReading readPart(const std::filesystem::path& file, const std::vector<std::string>& columns,
                     const std::function<bool(const std::vector<std::string_view>& cells, std::uint64_t offset)>& take);

/// Appends rows to a file that belongs to this process and is created with the first row. Each row is one write at
/// the end of the file: a killed process leaves complete rows and at most one that is cut short. Not thread-safe.
class PartWriter {
 public:
  /// The file is `name`.csv; if that exists, `name`_2.csv and so on.
  PartWriter(std::filesystem::path folder, std::string name, std::vector<std::string> columns);
  ~PartWriter();
  PartWriter(const PartWriter&) = delete;
  PartWriter& operator=(const PartWriter&) = delete;

  /// Returns the offset of the row in bytes. Line ends inside cells become blanks. Throws Failure, for example if the
  /// disk is full; no row is written behind one that is cut short.
  std::uint64_t append(const TableRow& row);
  /// Empty before the first row is written.
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
