// Reading and writing tables.
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
#include "experiments/base/failure.h"
#include "experiments/tables/new_file.h"
#include "irk/misuse.h"

namespace irk {

/// Reads the cells of one row after another; quoted cells may span lines.
class TableFile::Reader {
 public:
  explicit Reader(std::streambuf& in) : in_(in) {}
  bool atEnd() { return in_.sgetc() == kEnd; }
  int line() const { return line_; }
  std::uint64_t position() const { return position_; }

  void seek(std::uint64_t position) {
    if (position == position_) return;
    in_.pubseekpos(static_cast<std::streamoff>(position), std::ios::in);
    position_ = position;
  }

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

  char next() {
    ++position_;
    return static_cast<char>(in_.sbumpc());
  }

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
  std::uint64_t position_ = 0;
  int line_ = 1;
};

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

TableFile::TableFile(std::filesystem::path file)
    : path_(std::move(file)), in_(opened(path_)), reader_(std::make_unique<Reader>(*in_.rdbuf())) {
  try {
    while (!reader_->atEnd() && reader_->isComment()) {
      if (const auto line = reader_->rest()) readHeadLine(*line, names_);
    }
    const auto columns = reader_->atEnd() ? std::nullopt : reader_->row(1);
    if (!columns) throw Misuse(fmt::format("{}: no line with column names", path_.string()));
    names_.columns = *columns;
  } catch (const std::ios_base::failure& failure) {
    throw Misuse(fmt::format("file '{}' cannot be read: {}", path_.string(), failure.what()));
  }
}

TableFile::~TableFile() = default;

std::optional<TableRow> TableFile::next() try {
  if (reader_->atEnd()) return {};
  const int line = reader_->line();
  auto row = reader_->row(names_.columns.size());
  if (row && row->size() == names_.columns.size()) return row;
  if (reader_->atEnd()) return {};
  throw Misuse(fmt::format("{}:{}: {} cells, the columns are {}", path_.string(), line, row ? row->size() : 0,
                           names_.columns.size()));
} catch (const std::ios_base::failure& failure) {
  throw Misuse(fmt::format("file '{}' cannot be read: {}", path_.string(), failure.what()));
}

std::uint64_t TableFile::position() const { return reader_->position(); }
void TableFile::seek(std::uint64_t position) { reader_->seek(position); }

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

TableWriter::TableWriter(std::filesystem::path file, const TableHead& head, const std::vector<std::string>& columns)
    : file_(std::move(file)) {
  if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path());
  beside_ = newBeside(file_);
  out_.open(beside_, std::ios::binary);
  for (const auto& [key, value] : head) out_ << "# " << key << ": " << value << '\n';
  add(columns);
}

TableWriter::~TableWriter() {
  if (!out_.is_open()) return;
  out_.close();
  std::error_code none;
  std::filesystem::remove(beside_, none);
}

void TableWriter::add(const TableRow& row) {
  if (!(out_ << csvLine(row) << '\n')) {
    throw Failure(fmt::format("cannot write {}: {}", beside_.string(), std::strerror(errno)));
  }
}

void TableWriter::close() {
  if (!out_.flush()) throw Failure(fmt::format("cannot write {}: {}", beside_.string(), std::strerror(errno)));
  out_.close();
  std::filesystem::rename(beside_, file_);
}

void writeTable(const std::filesystem::path& path, const Table& table) {
  TableWriter out(path, table.head, table.columns);
  for (const auto& row : table.rows) out.add(row);
  out.close();
}

}  // namespace irk
