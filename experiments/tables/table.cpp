#include "experiments/tables/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/base/text.h"
#include "experiments/base/failure.h"
#include "irk/misuse.h"

namespace irk {
namespace {

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

[[noreturn]] void cannotWrite(const std::filesystem::path& path) {
  throw Failure(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
}

}  // namespace

std::size_t Table::column(std::string_view name) const {
  const auto at = std::find(columns.begin(), columns.end(), name);
  if (at == columns.end()) throw Misuse(unknownName("column", name, columns));
  return static_cast<std::size_t>(at - columns.begin());
}

bool Table::hasColumn(std::string_view name) const {
  return std::find(columns.begin(), columns.end(), name) != columns.end();
}

std::string csvLine(const TableRow& row) {
  std::string line;
  for (const auto& cell : row) {
    if (&cell != &row.front()) line += ',';
    line += quoted(cell);
  }
  return line;
}

RowWriter::RowWriter(const std::filesystem::path& path, const Table& table) {
  writeTable(path, table);
  file_.reset(std::fopen(path.c_str(), "ab"));
  if (!file_) cannotWrite(path);
}

void RowWriter::append(const TableRow& row) {
  std::fputs((csvLine(row) + '\n').c_str(), file_.get());
  if (std::fflush(file_.get()) != 0) throw Failure("cannot write a row: is the disk full?");
}

}  // namespace irk
