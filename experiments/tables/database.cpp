#include "experiments/tables/database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <utility>

#include "experiments/tables/csv_module.h"

namespace irk {
namespace {

// A name of no characters: a database in SQLite's cache, which is written to a temporary file when it is full.
constexpr const char* kThrownAway = "";
constexpr const char* kSettings = "pragma cache_size = -64000; pragma journal_mode = off; pragma synchronous = off";

}  // namespace

void Database::Close::operator()(sqlite3* database) const { sqlite3_close(database); }

Database::Database() : thrown_(std::make_shared<std::exception_ptr>()) {
  sqlite3* database = nullptr;
  const int opened = sqlite3_open(kThrownAway, &database);
  database_.reset(database);
  if (opened != SQLITE_OK) throw QueryError(fmt::format("no database: {}", sqlite3_errstr(opened)));
  run(kSettings);
}

void Database::addFile(const std::string& name, const std::filesystem::path& file) {
  if (addCsvModule(database_.get(), name, file, thrown_) != SQLITE_OK) {
    throw QueryError(fmt::format("table {}: {}", name, sqlite3_errmsg(database_.get())));
  }
}

void Database::run(std::string_view statements) {
  *thrown_ = nullptr;
  if (sqlite3_exec(database_.get(), std::string(statements).c_str(), nullptr, nullptr, nullptr) == SQLITE_OK) return;
  if (*thrown_) std::rethrow_exception(*thrown_);
  throw QueryError(fmt::format("{} in '{}'", sqlite3_errmsg(database_.get()), statements));
}

void Query::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Query::Query(Database& database, std::string_view statement) : database_(database) {
  auto* const handle = database_.database_.get();
  sqlite3_stmt* made = nullptr;
  const char* rest = nullptr;
  *database_.thrown_ = nullptr;
  const int length = static_cast<int>(statement.size());
  const int prepared = sqlite3_prepare_v2(handle, statement.data(), length, &made, &rest);
  statement_.reset(made);
  if (*database_.thrown_) std::rethrow_exception(*database_.thrown_);
  if (prepared != SQLITE_OK) {
    const int at = sqlite3_error_offset(handle);
    throw QueryError(at < 0 ? fmt::format("{} in '{}'", sqlite3_errmsg(handle), statement)
                            : fmt::format("{} in '{}', character {}", sqlite3_errmsg(handle), statement, at + 1));
  }
  const auto behind = statement.substr(static_cast<std::size_t>(rest - statement.data()));
  if (!made || behind.find_first_not_of(" \t\r\n;") != behind.npos) {
    throw QueryError(fmt::format("one statement is expected, not '{}'", statement));
  }
}

void Query::fail() const {
  if (*database_.thrown_) std::rethrow_exception(*database_.thrown_);
  throw QueryError(fmt::format("{} in '{}'", sqlite3_errmsg(database_.database_.get()), sqlite3_sql(statement_.get())));
}

void Query::bind(int parameter, std::string_view value) {
  if (sqlite3_bind_text64(statement_.get(), parameter, value.data(), value.size(), SQLITE_TRANSIENT, SQLITE_UTF8) !=
      SQLITE_OK) {
    fail();
  }
}

bool Query::next() {
  const int status = sqlite3_step(statement_.get());
  if (status == SQLITE_ROW) return true;
  if (status != SQLITE_DONE) fail();
  sqlite3_reset(statement_.get());
  return false;
}

bool Query::onlyReads() const { return sqlite3_stmt_readonly(statement_.get()) != 0; }

std::vector<std::string> Query::columns() const {
  std::vector<std::string> names;
  const int count = sqlite3_column_count(statement_.get());
  for (int i = 0; i < count; ++i) names.emplace_back(sqlite3_column_name(statement_.get(), i));
  return names;
}

Query::Type Query::type(int column) const {
  switch (sqlite3_column_type(statement_.get(), column)) {
    case SQLITE_INTEGER:
      return Type::kInteger;
    case SQLITE_FLOAT:
      return Type::kReal;
    case SQLITE_NULL:
      return Type::kNull;
    default:  // a text, or bytes
      return Type::kText;
  }
}

std::int64_t Query::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }
double Query::real(int column) const { return sqlite3_column_double(statement_.get(), column); }

std::string_view Query::text(int column) const {
  const auto* const bytes = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
  return {bytes ? bytes : "", static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

}  // namespace irk
