// CSV tables that explain themselves: a head of `# key: value` lines, then columns by name.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace irk {

using TableHead = std::vector<std::pair<std::string, std::string>>;
using TableRow = std::vector<std::string>;

struct Table {
  TableHead head;
  std::vector<std::string> columns;
  std::vector<TableRow> rows;

  /// Throws Misuse naming the nearest column.
  std::size_t column(std::string_view name) const;
  bool hasColumn(std::string_view name) const;
};

/// One line, without its end. RFC 4180: cells with commas, quotes or line ends are quoted.
std::string csvLine(const TableRow& row);

/// A last row that is cut short (no line end, or too few cells) is dropped: an interrupted program
/// may leave one. Throws Misuse with file and line for other damage, or if it cannot be read.
Table readTable(const std::filesystem::path& path);

/// Writes beside the target and renames, so that no reader ever sees half a table.
void writeTable(const std::filesystem::path& path, const Table& table);

/// Appends row by row and flushes each: an interrupt loses no finished row. Not thread-safe.
class RowWriter {
 public:
  /// Starts the file with what `table` holds already.
  RowWriter(const std::filesystem::path& path, const Table& table);
  void append(const TableRow& row);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace irk
