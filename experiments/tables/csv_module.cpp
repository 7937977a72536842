#include "experiments/tables/csv_module.h"

#include <sqlite3.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "experiments/tables/table_rows.h"

namespace irk {

std::string quotedName(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text.append(c == '"' ? 2 : 1, c);
  return text + '"';
}

namespace {

// Hashes such as 12345678 or 1e5, and lists that may have one number only.
constexpr std::string_view kTextColumns[] = {"key",         "code",  "environment", "cpu_environment",
                                             "calibration", "trial", "commit",      "version",
                                             "cpu_all",     "state", "bar"};

struct CsvSource {
  std::filesystem::path file;
  std::shared_ptr<std::exception_ptr> thrown;
};

struct CsvTable : sqlite3_vtab {
  CsvSource* source;
  std::vector<bool> is_text;  // by column
};

struct CsvCursor : sqlite3_vtab_cursor {
  explicit CsvCursor(const std::filesystem::path& path) : file(path), start(file.position()) {}

  void advance() {
    position = file.position();
    row = file.next();
  }

  TableFile file;
  std::uint64_t start, position = 0;
  std::optional<TableRow> row;
};

// Exceptions must not pass through SQLite.
int csvGuarded(const CsvSource& source, const std::function<void()>& act) {
  try {
    act();
    return SQLITE_OK;
  } catch (...) {
    *source.thrown = std::current_exception();
    return SQLITE_ERROR;
  }
}

const CsvSource& csvSourceOf(sqlite3_vtab_cursor* cursor) { return *static_cast<CsvTable*>(cursor->pVtab)->source; }

int csvConnect(sqlite3* database, void* source, int, const char* const*, sqlite3_vtab** made, char**) {
  auto table = std::make_unique<CsvTable>();
  table->source = static_cast<CsvSource*>(source);
  std::string declaration;
  const int read = csvGuarded(*table->source, [&] {
    const TableFile file(table->source->file);
    for (const auto& column : file.names().columns) {
      declaration.append(declaration.empty() ? "create table csv(" : ", ").append(quotedName(column));
      const bool is_text =
          std::find(std::begin(kTextColumns), std::end(kTextColumns), column) != std::end(kTextColumns);
      if (is_text) declaration += " text";
      table->is_text.push_back(is_text);
    }
  });
  if (read != SQLITE_OK) return read;
  const int declared = sqlite3_declare_vtab(database, (declaration + ')').c_str());
  if (declared == SQLITE_OK) *made = table.release();
  return declared;
}

int csvDisconnect(sqlite3_vtab* table) {
  delete static_cast<CsvTable*>(table);
  return SQLITE_OK;
}

// A file is always read as a whole, row by row. In a join, SQLite reads one file again for each row of the other; the
// sizes told here let it choose the smaller one for that.
int csvBestIndex(sqlite3_vtab* table, sqlite3_index_info* plan) {
  std::error_code unknown;
  const auto bytes = std::filesystem::file_size(static_cast<CsvTable*>(table)->source->file, unknown);
  constexpr double kBytesPerRow = 500;
  plan->estimatedCost = unknown ? 1e6 : static_cast<double>(bytes);
  plan->estimatedRows = 1 + static_cast<sqlite3_int64>(plan->estimatedCost / kBytesPerRow);
  return SQLITE_OK;
}

int csvOpen(sqlite3_vtab* table, sqlite3_vtab_cursor** cursor) {
  const CsvSource& source = *static_cast<CsvTable*>(table)->source;
  return csvGuarded(source, [&] { *cursor = std::make_unique<CsvCursor>(source.file).release(); });
}

int csvClose(sqlite3_vtab_cursor* cursor) {
  delete static_cast<CsvCursor*>(cursor);
  return SQLITE_OK;
}

int csvFilter(sqlite3_vtab_cursor* cursor, int, const char*, int, sqlite3_value**) {
  auto& csv = *static_cast<CsvCursor*>(cursor);
  return csvGuarded(csvSourceOf(cursor), [&csv] {
    csv.file.seek(csv.start);
    csv.advance();
  });
}

int csvNext(sqlite3_vtab_cursor* cursor) {
  auto& csv = *static_cast<CsvCursor*>(cursor);
  return csvGuarded(csvSourceOf(cursor), [&csv] { csv.advance(); });
}

int csvEof(sqlite3_vtab_cursor* cursor) { return static_cast<CsvCursor*>(cursor)->row ? 0 : 1; }

// Whether the cell is such a number and nothing else.
template <class Number>
bool isNumber(std::string_view cell, Number& number) {
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  return error == std::errc() && end == cell.data() + cell.size();
}

int csvColumn(sqlite3_vtab_cursor* cursor, sqlite3_context* result, int column) {
  const auto at = static_cast<std::size_t>(column);
  const std::string& cell = static_cast<CsvCursor*>(cursor)->row->at(at);
  std::int64_t integer = 0;
  double real = 0;
  const bool is_text = static_cast<CsvTable*>(cursor->pVtab)->is_text[at];
  if (!is_text && isNumber(cell, integer)) {
    sqlite3_result_int64(result, integer);
  } else if (!is_text && isNumber(cell, real)) {
    sqlite3_result_double(result, real);  // NaN becomes null
  } else {
    sqlite3_result_text64(result, cell.data(), cell.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
  }
  return SQLITE_OK;
}

int csvRowid(sqlite3_vtab_cursor* cursor, sqlite3_int64* id) {
  *id = static_cast<sqlite3_int64>(static_cast<CsvCursor*>(cursor)->position);
  return SQLITE_OK;
}

// Without xCreate the table is there without `create virtual table`.
const sqlite3_module kCsvModule = [] {
  sqlite3_module module{};
  module.xConnect = csvConnect;
  module.xBestIndex = csvBestIndex;
  module.xDisconnect = csvDisconnect;
  module.xOpen = csvOpen;
  module.xClose = csvClose;
  module.xFilter = csvFilter;
  module.xNext = csvNext;
  module.xEof = csvEof;
  module.xColumn = csvColumn;
  module.xRowid = csvRowid;
  return module;
}();

}  // namespace

int addCsvModule(sqlite3* database, const std::string& name, const std::filesystem::path& file,
                 std::shared_ptr<std::exception_ptr> thrown) {
  return sqlite3_create_module_v2(database, name.c_str(), &kCsvModule, new CsvSource{file, std::move(thrown)},
                                  [](void* source) { delete static_cast<CsvSource*>(source); });
}

}  // namespace irk
