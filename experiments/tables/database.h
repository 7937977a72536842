// Queries over tables in files, by SQLite. The files stay the truth: a database is made for a query and thrown away.
#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/base/failure.h"

struct sqlite3;
struct sqlite3_stmt;

namespace irk {

/// SQLite's message about a statement, and the statement.
class QueryError : public Failure {
 public:
  using Failure::Failure;
};

/// A database that vanishes with this object. Its tables are in memory up to 64 MB, beyond that in a temporary file
/// (TMPDIR). Not thread-safe. Throws QueryError.
class Database {
 public:
  Database();

  /// Makes the table in a file known by `name`; every query that names it reads the file for each use, and in a
  /// join once for each row of the other table (unless it is `materialized`). A cell that
  /// is a number is a number, `nan` is null, any other cell is a text, and so are all cells of columns that hold hashes
  /// or lists (kTextColumns). `rowid` is where a row begins: TableFile::seek goes there. Queries throw what readTable
  /// throws.
  void addFile(const std::string& name, const std::filesystem::path& file);
  /// Runs statements that give no rows.
  void run(std::string_view statements);

 private:
  friend class Query;
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::shared_ptr<std::exception_ptr> thrown_;  // by a file that could not be read
  std::unique_ptr<sqlite3, Close> database_;
};

/// One statement with its rows. `database` must outlive it. Throws QueryError.
class Query {
 public:
  /// Throws QueryError if `statement` is no statement, or more than one.
  Query(Database& database, std::string_view statement);

  /// Sets the statement's parameter ?1, ?2, ...
  void bind(int parameter, std::string_view value);
  /// Goes to the next row; false behind the last one, and then the statement can be run again.
  bool next();

  /// Whether it changes nothing.
  bool onlyReads() const;
  /// The names of its columns.
  std::vector<std::string> columns() const;

  /// A cell of the row; column 0 is the first.
  enum class Type { kInteger, kReal, kText, kNull };
  Type type(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;
  /// Valid until the next call of `next`.
  std::string_view text(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  [[noreturn]] void fail() const;

  Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

}  // namespace irk
