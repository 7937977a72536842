#include "experiments/tables/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>

#include "core/base/input_file.h"
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

/// Reads the cells of one row after another; quoted cells may span lines.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}
  bool atEnd() const { return at_ == text_.size(); }
  int line() const { return line_; }

  bool isComment() const { return text_[at_] == '#'; }

  /// The rest of the line; nullopt if the line has no end.
  std::optional<std::string_view> rest() {
    const auto end = text_.find('\n', at_);
    if (end == std::string_view::npos) return cutShort();
    const auto found = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++line_;
    return found;
  }

  /// The next row; nullopt if it has no end.
  std::optional<TableRow> row() {
    TableRow cells(1);
    while (at_ < text_.size()) {
      const char c = text_[at_++];
      if (c == '"') {
        if (!quotedPart(cells.back())) return cutShort();
      } else if (c == ',') {
        cells.emplace_back();
      } else if (c == '\n') {
        ++line_;
        return cells;
      } else if (c != '\r') {
        cells.back() += c;
      }
    }
    return {};
  }

 private:
  std::nullopt_t cutShort() {
    at_ = text_.size();
    return std::nullopt;
  }

  // Reads behind an opening quote up to the closing one; a doubled quote stands for one character.
  bool quotedPart(std::string& cell) {
    while (at_ < text_.size()) {
      const char c = text_[at_++];
      const bool doubled = c == '"' && at_ < text_.size() && text_[at_] == '"';
      if (c == '"' && !doubled) return true;
      if (doubled) ++at_;
      if (c == '\n') ++line_;
      cell += c;
    }
    return false;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

void readHeadLine(std::string_view line, Table& table) {
  line.remove_prefix(1);
  const auto colon = line.find(": ");
  if (colon == std::string_view::npos || !line.starts_with(' ')) return;
  table.head.emplace_back(line.substr(1, colon - 1), line.substr(colon + 2));
}

std::string startOf(const Table& table) {
  std::string text;
  for (const auto& [key, value] : table.head) text += fmt::format("# {}: {}\n", key, value);
  text += csvLine(table.columns) + '\n';
  for (const auto& row : table.rows) text += csvLine(row) + '\n';
  return text;
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

Table readTable(const std::filesystem::path& path) {
  const std::string text = readInputFile(path, kMaxTableBytes);
  Table table;
  Reader reader(text);
  while (!reader.atEnd() && reader.isComment()) {
    if (const auto line = reader.rest()) readHeadLine(*line, table);
  }
  const auto columns = reader.atEnd() ? std::nullopt : reader.row();
  if (!columns) throw Misuse(fmt::format("{}: no line with column names", path.string()));
  table.columns = *columns;
  while (!reader.atEnd()) {
    const int line = reader.line();
    auto row = reader.row();
    const bool complete = row && row->size() == table.columns.size();
    if (complete) {
      table.rows.push_back(std::move(*row));
    } else if (!reader.atEnd()) {
      throw Misuse(fmt::format("{}:{}: {} cells, the columns are {}", path.string(), line, row ? row->size() : 0,
                               table.columns.size()));
    }
  }
  return table;
}

void writeTable(const std::filesystem::path& path, const Table& table) {
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  const std::filesystem::path beside = path.string() + ".new";
  {
    std::ofstream out(beside, std::ios::binary);
    if (!(out << startOf(table)).flush()) cannotWrite(beside);
  }
  std::filesystem::rename(beside, path);
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
