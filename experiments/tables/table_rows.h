// Tables that may be larger than the memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "experiments/tables/table.h"

namespace irk {

/// Reads the rows of a table in a file, one at a time. Throws what readTable throws. If the file is replaced, it
/// continues to read the old one. Not thread-safe.
class TableFile {
 public:
  /// Reads the head and the columns.
  explicit TableFile(std::filesystem::path file);
  ~TableFile();

  /// Head and columns, no rows.
  const Table& names() const { return names_; }
  /// The next row; nullopt behind the last one.
  std::optional<TableRow> next();
  /// Where the next row begins, in bytes; `seek` returns there.
  std::uint64_t position() const;
  void seek(std::uint64_t position);

 private:
  class Reader;
  std::filesystem::path path_;
  std::ifstream in_;
  std::unique_ptr<Reader> reader_;
  Table names_;
};

/// Calls `take` for every row of a table in its order, as readTable gives them; memory holds one row at a time. `names`
/// has the head and the columns, and no rows; it is returned, too. Throws what readTable throws.
Table forEachRow(const std::filesystem::path& path, const std::function<void(const Table& names, TableRow row)>& take);

/// A table in a file whose rows are written one after another. Throws Failure.
class TableWriter {
 public:
  /// Writes beside `file`.
  TableWriter(std::filesystem::path file, const TableHead& head, const std::vector<std::string>& columns);
  /// Removes the file unless `close` was called.
  ~TableWriter();
  TableWriter(const TableWriter&) = delete;
  TableWriter& operator=(const TableWriter&) = delete;

  void add(const TableRow& row);
  /// Renames the file, so that readers never see a partial table.
  void close();

 private:
  std::filesystem::path file_, beside_;
  std::ofstream out_;
};

}  // namespace irk
