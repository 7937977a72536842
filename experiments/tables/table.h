// CSV tables with a head of `# key: value` lines; columns are found by name.
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

/// The value of the first line of the head with this key; empty if there is none.
std::string headEntry(const TableHead& head, std::string_view key);

struct Table {
  TableHead head;
  std::vector<std::string> columns;
  std::vector<TableRow> rows;

  /// The column's index. Throws Misuse for an unknown name, naming the nearest column.
  std::size_t column(std::string_view name) const;
  bool hasColumn(std::string_view name) const;
};

/// One CSV line without its line end. RFC 4180: cells with commas, quotes or line ends are quoted.
std::string csvLine(const TableRow& row);

/// Splits what csvLine gives into its written cells, quotes included. Returns false for an unbalanced quote, for one
/// inside of a cell without quotes, and for text behind a closing one.
bool splitLine(std::string_view line, std::vector<std::string_view>& cells);
/// The value of a written cell, without its quotes.
std::string plainCell(std::string_view written);
TableRow plainRow(const std::vector<std::string_view>& cells);

/// Drops a last row that is cut short (no line end, or too few cells), as an interrupted program may leave one.
/// Throws Misuse with file and line for other damage, and if the file cannot be read.
Table readTable(const std::filesystem::path& path);

/// Writes to a file beside the target and renames it, so that readers never see a partial table.
void writeTable(const std::filesystem::path& path, const Table& table);

/// Appends rows and flushes after each: an interrupt loses no finished row. Not thread-safe.
class RowWriter {
 public:
  /// Starts the file with the head, columns and rows of `table`.
  RowWriter(const std::filesystem::path& path, const Table& table);
  void append(const TableRow& row);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace irk
