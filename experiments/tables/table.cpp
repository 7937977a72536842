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

// The end of the cell that begins at `at`; npos if the cell is damaged.
std::size_t cellEnd(std::string_view line, std::size_t at) {
  if (at == line.size() || line[at] != '"') {
    while (at < line.size() && line[at] != ',' && line[at] != '"') ++at;
    return at < line.size() && line[at] == '"' ? line.npos : at;
  }
  for (++at;; at += 2) {
    at = line.find('"', at);
    if (at == line.npos) return line.npos;
    if (at + 1 == line.size() || line[at + 1] == ',') return at + 1;
    if (line[at + 1] != '"') return line.npos;
  }
}

[[noreturn]] void cannotWrite(const std::filesystem::path& path) {
  throw Failure(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
}

}  // namespace

std::string headEntry(const TableHead& head, std::string_view key) {
  const auto at = std::ranges::find(head, key, &TableHead::value_type::first);
  return at == head.end() ? "" : at->second;
}

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

bool splitLine(std::string_view line, std::vector<std::string_view>& cells) {
  cells.clear();
  for (std::size_t at = 0;;) {
    const auto end = cellEnd(line, at);
    if (end == line.npos) return false;
    cells.push_back(line.substr(at, end - at));
    if (end == line.size()) return true;
    at = end + 1;
  }
}

std::string plainCell(std::string_view written) {
  if (!written.starts_with('"')) return std::string(written);
  std::string text;
  for (std::size_t i = 1; i + 1 < written.size(); ++i) {
    text += written[i];
    if (written[i] == '"') ++i;  // a doubled quote is one character
  }
  return text;
}

TableRow plainRow(const std::vector<std::string_view>& cells) {
  TableRow row;
  row.reserve(cells.size());
  for (const auto cell : cells) row.push_back(plainCell(cell));
  return row;
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
