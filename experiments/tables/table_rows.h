// Tables that may be larger than the memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/tables/new_file.h"
#include "experiments/tables/table.h"

namespace irk {

/// Reads the rows of a table in a file, one at a time. Throws what readTable throws. If the file is replaced, it
/// continues to read the old one. Not thread-safe.
class TableFile {
 public:
  /// Reads the head and the columns.
  explicit TableFile(std::filesystem::path file);

  /// Head and columns, no rows.
  const Table& names() const { return names_; }
  /// The next row; nullopt behind the last one.
  std::optional<TableRow> next();
  /// Where the next row begins, in bytes; `seek` returns there.
  std::uint64_t position() const { return position_; }
  void seek(std::uint64_t position);

 private:
  bool nextLine();
  bool nextRow();

  std::filesystem::path path_;
  std::ifstream in_;
  std::uint64_t position_ = 0;
  std::size_t lines_ = 0;                // that were read
  std::string line_, text_;              // the last line, the last row
  std::vector<std::string_view> cells_;  // of `text_`
  Table names_;
};

/// Calls `take` for every row of a table in its order, as readTable gives them; memory holds one row at a time. `names`
/// has the head and the columns, and no rows; it is returned, too. Throws what readTable throws.
Table forEachRow(const std::filesystem::path& path, const std::function<void(const Table& names, TableRow row)>& take);

/// A table in a file whose rows are written one after another. Throws Failure.
class TableWriter {
 public:
  TableWriter(const std::filesystem::path& file, const TableHead& head, const std::vector<std::string>& columns);

  void add(const TableRow& row) { addLine(csvLine(row)); }
  /// Adds a row as csvLine gives it.
  void addLine(std::string_view line);
  /// Without it, nothing is written (NewFile).
  void close() { file_.close(); }

 private:
  NewFile file_;
};

}  // namespace irk
