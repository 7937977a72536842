// Reading and writing tables.
#include "experiments/tables/table_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/base/input_file.h"
#include "irk/misuse.h"

namespace irk {
namespace {

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

TableFile::TableFile(std::filesystem::path file) : path_(std::move(file)), in_(opened(path_)) {
  while (in_.peek() == '#') {
    if (nextLine()) readHeadLine(line_, names_);
  }
  if (!nextRow() || cells_.empty()) throw Misuse(fmt::format("{}: no line with column names", path_.string()));
  names_.columns = plainRow(cells_);
}

// False behind the last line, and for a line without a line end.
bool TableFile::nextLine() {
  std::getline(in_, line_);
  if (in_.bad()) throw Misuse(fmt::format("file '{}' cannot be read: {}", path_.string(), std::strerror(errno)));
  position_ += line_.size() + (in_.eof() ? 0 : 1);
  ++lines_;
  return in_.good();
}

// Reads into `text_` and `cells_`; quoted cells may span lines, and damaged ones leave no cells. False behind the last
// row, and for a row that is cut short.
bool TableFile::nextRow() {
  const auto first = lines_ + 1;
  bool quoted = false;
  for (text_.clear(); nextLine(); text_ += '\n') {
    text_ += line_;
    if (std::count(line_.begin(), line_.end(), '"') % 2 != 0) quoted = !quoted;
    if (quoted) continue;
    if (text_.ends_with('\r')) text_.pop_back();
    if (!splitLine(text_, cells_)) cells_.clear();
    return true;
  }
  if (quoted && line_.empty()) throw Misuse(fmt::format("{}:{}: a quote has no end", path_.string(), first));
  return false;
}

std::optional<TableRow> TableFile::next() {
  const auto line = lines_ + 1;
  const bool ends = nextRow();
  if (ends && cells_.size() == names_.columns.size()) return plainRow(cells_);
  if (!ends || in_.peek() == std::ifstream::traits_type::eof()) return {};
  const std::string why = cells_.empty() ? "a quote is unbalanced" : fmt::format("{} cells", cells_.size());
  throw Misuse(fmt::format("{}:{}: {}, the columns are {}", path_.string(), line, why, names_.columns.size()));
}

void TableFile::seek(std::uint64_t position) {
  if (position == position_ && in_.good()) return;
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(position));
  position_ = position;
}

Table forEachRow(const std::filesystem::path& path, const std::function<void(const Table& names, TableRow row)>& take) {
  TableFile file(path);
  while (auto row = file.next()) take(file.names(), std::move(*row));
  return file.names();
}

Table readTable(const std::filesystem::path& path) {
  std::vector<TableRow> rows;
  Table table = forEachRow(path, [&rows](const Table&, TableRow row) { rows.push_back(std::move(row)); });
  table.rows = std::move(rows);
  return table;
}

TableWriter::TableWriter(const std::filesystem::path& file, const TableHead& head,
                         const std::vector<std::string>& columns)
    : file_(file) {
  for (const auto& [key, value] : head) addLine(fmt::format("# {}: {}", key, value));
  add(columns);
}

void TableWriter::addLine(std::string_view line) {
  file_.out() << line << '\n';
  file_.check();
}

void writeTable(const std::filesystem::path& path, const Table& table) {
  TableWriter out(path, table.head, table.columns);
  for (const auto& row : table.rows) out.add(row);
  out.close();
}

}  // namespace irk
