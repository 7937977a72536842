// Reading tables.
#include "experiments/tables/table_rows.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <ios>
#include <optional>
#include <streambuf>
#include <system_error>
#include <utility>

#include "core/base/input_file.h"
#include "irk/misuse.h"

namespace irk {
namespace {

/// Reads the cells of one row after another; quoted cells may span lines.
class Reader {
 public:
  explicit Reader(std::streambuf& in) : in_(in) {}
  bool atEnd() { return in_.sgetc() == kEnd; }
  int line() const { return line_; }

  bool isComment() { return in_.sgetc() == '#'; }

  /// The rest of the line; nullopt if the line has no end.
  std::optional<std::string> rest() {
    std::string text;
    while (!atEnd()) {
      const char c = next();
      if (c == '\n') {
        ++line_;
        return text;
      }
      text += c;
    }
    return {};
  }

  /// The next row; nullopt if it has no end. Most rows have `usual` cells.
  std::optional<TableRow> row(std::size_t usual) {
    TableRow cells;
    cells.reserve(usual);
    cells.emplace_back();
    while (!atEnd()) {
      const char c = next();
      if (c == '"') {
        if (!quotedPart(cells.back())) return {};
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
  static constexpr int kEnd = std::streambuf::traits_type::eof();

  char next() { return static_cast<char>(in_.sbumpc()); }

  // Reads behind an opening quote up to the closing one; a doubled quote stands for one character.
  bool quotedPart(std::string& cell) {
    while (!atEnd()) {
      const char c = next();
      const bool doubled = c == '"' && in_.sgetc() == '"';
      if (c == '"' && !doubled) return true;
      if (doubled) next();
      if (c == '\n') ++line_;
      cell += c;
    }
    return false;
  }

  std::streambuf& in_;
  int line_ = 1;
};

void readHeadLine(std::string_view line, Table& table) {
  line.remove_prefix(1);
  const auto colon = line.find(": ");
  if (colon == std::string_view::npos || !line.starts_with(' ')) return;
  table.head.emplace_back(line.substr(1, colon - 1), line.substr(colon + 2));
}

// A regular file of at most kMaxTableBytes.
std::ifstream opened(const std::filesystem::path& path) {
  requireRegularFile(path);
  std::error_code error;
  if (std::filesystem::file_size(path, error) > kMaxTableBytes && !error) {
    throw Misuse(fmt::format("file '{}' is too long: up to {} bytes are read", path.string(), kMaxTableBytes));
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Misuse(fmt::format("file '{}' cannot be read: {}", path.string(), std::strerror(errno)));
  return in;
}

}  // namespace

Table forEachRow(const std::filesystem::path& path,
                 const std::function<void(const Table& names, TableRow row)>& take) try {
  std::ifstream in = opened(path);
  Reader reader(*in.rdbuf());
  Table names;
  while (!reader.atEnd() && reader.isComment()) {
    if (const auto line = reader.rest()) readHeadLine(*line, names);
  }
  const auto columns = reader.atEnd() ? std::nullopt : reader.row(1);
  if (!columns) throw Misuse(fmt::format("{}: no line with column names", path.string()));
  names.columns = *columns;
  while (!reader.atEnd()) {
    const int line = reader.line();
    auto row = reader.row(names.columns.size());
    const bool complete = row && row->size() == names.columns.size();
    if (complete) {
      take(names, std::move(*row));
    } else if (!reader.atEnd()) {
      throw Misuse(fmt::format("{}:{}: {} cells, the columns are {}", path.string(), line, row ? row->size() : 0,
                               names.columns.size()));
    }
  }
  return names;
} catch (const std::ios_base::failure& failure) {
  throw Misuse(fmt::format("file '{}' cannot be read: {}", path.string(), failure.what()));
}

Table readTable(const std::filesystem::path& path) {
  std::vector<TableRow> rows;
  Table table = forEachRow(path, [&rows](const Table&, TableRow row) { rows.push_back(std::move(row)); });
  table.rows = std::move(rows);
  return table;
}

}  // namespace irk
