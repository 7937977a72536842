// irk query and irk export: the tables of a study for SQL.
#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/base/failure.h"
#include "experiments/commands/commands.h"
#include "experiments/study/study_reader.h"
#include "experiments/tables/csv_module.h"
#include "experiments/tables/database.h"
#include "experiments/tables/new_file.h"
#include "experiments/tables/table.h"
#include "irk/misuse.h"

namespace irk {
namespace {

constexpr std::int32_t kApplicationId = 0x69726B31;  // "irk1", which tells our databases from those of others

// The tables of a study in its folder, by name.
std::vector<std::filesystem::path> tablesOf(const TableOptions& options) {
  const auto id = isStudyFile(options.study) ? loadStudy(options.study, options.variant).id : options.study;
  const auto folder = std::filesystem::path(options.results) / id;
  if (!std::filesystem::is_regular_file(folder / "runs.csv")) {
    throw Failure(
        fmt::format("no results of study '{}' in '{}': irk run {} makes them", id, options.results, options.study));
  }
  std::vector<std::filesystem::path> tables;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv" && entry.is_regular_file()) tables.push_back(entry.path());
  }
  std::sort(tables.begin(), tables.end());
  return tables;
}

// Their names; the database knows them.
std::vector<std::string> addAll(const std::vector<std::filesystem::path>& tables, Database& database) {
  std::vector<std::string> names;
  for (const auto& table : tables) {
    names.push_back(table.stem().string());
    database.addFile(names.back(), table);
  }
  return names;
}

std::string cellText(const Query& query, int column) {
  switch (query.type(column)) {
    case Query::Type::kInteger:
      return std::to_string(query.integer(column));
    case Query::Type::kReal:
      return numberText(query.real(column));
    case Query::Type::kText:
      return std::string(query.text(column));
    case Query::Type::kNull:
      break;
  }
  return "nan";
}

nlohmann::ordered_json cellJson(const Query& query, int column) {
  switch (query.type(column)) {
    case Query::Type::kInteger:
      return query.integer(column);
    case Query::Type::kReal:
      return query.real(column);
    case Query::Type::kText:
      return query.text(column);
    case Query::Type::kNull:
      break;
  }
  return nullptr;
}

// A JSON object has one value for each name.
void requireDifferent(std::vector<std::string> columns) {
  std::sort(columns.begin(), columns.end());
  const auto twice = std::adjacent_find(columns.begin(), columns.end());
  if (twice == columns.end()) return;
  throw Misuse(fmt::format("--json: two columns have the name '{}'; give one of them another with `as`", *twice));
}

void printRows(Query& query, bool as_json, std::ostream& out) {
  const auto columns = query.columns();
  const auto count = static_cast<int>(columns.size());
  if (!as_json) out << csvLine(columns) << '\n';
  if (as_json) requireDifferent(columns);
  while (query.next()) {
    TableRow row;
    nlohmann::ordered_json object;
    for (int i = 0; i < count; ++i) {
      if (as_json) {
        object[columns[static_cast<std::size_t>(i)]] = cellJson(query, i);
      } else {
        row.push_back(cellText(query, i));
      }
    }
    constexpr auto kReplaced = nlohmann::json::error_handler_t::replace;  // what is no UTF-8
    out << (as_json ? object.dump(-1, ' ', false, kReplaced) : csvLine(row)) << '\n';
  }
}

bool isOwnDatabase(const std::filesystem::path& file) {
  constexpr std::size_t kIdAt = 68;  // in the header of 100 bytes: https://sqlite.org/fileformat.html, 1.3
  std::array<char, 100> header{};
  std::ifstream in(file, std::ios::binary);
  in.read(header.data(), header.size());
  std::uint32_t id = 0;
  for (std::size_t i = 0; i < sizeof id; ++i) id = id << 8 | static_cast<unsigned char>(header[kIdAt + i]);
  return in && std::string_view(header.data(), 16) == std::string_view("SQLite format 3\0", 16) && id == kApplicationId;
}

void writeDatabase(const std::vector<std::filesystem::path>& tables, const std::filesystem::path& file) {
  Database database;
  const auto names = addAll(tables, database);
  Query attach(database, "attach ?1 as exported");
  attach.bind(1, file.string());
  attach.next();
  database.run(fmt::format("pragma exported.journal_mode = off; pragma exported.application_id = {}", kApplicationId));
  for (const auto& name : names) {
    database.run(fmt::format("create table exported.{0} as select * from main.{0}", quotedName(name)));
  }
}

}  // namespace

int queryCommand(const TableOptions& options, Streams streams) {
  Database database;
  const auto names = addAll(tablesOf(options), database);
  const auto query = [&] {
    try {
      return Query(database, options.sql);
    } catch (const QueryError& error) {
      throw Misuse(fmt::format("{}; the tables are {}", error.what(), fmt::join(names, ", ")));
    }
  };
  auto asked = query();
  if (!asked.onlyReads() || asked.columns().empty())
    throw Misuse(fmt::format("'{}' would change tables: only select is allowed", options.sql));
  printRows(asked, options.json, streams.out);
  return 0;
}

int exportCommand(const TableOptions& options, Streams streams) {
  const auto tables = tablesOf(options);
  const std::filesystem::path file = options.file;
  if (std::filesystem::exists(file) && !isOwnDatabase(file)) {
    throw Misuse(
        fmt::format("'{}' is no database that irk export has written: it is kept; choose another name", options.file));
  }
  const auto beside = newBeside(file);
  try {
    writeDatabase(tables, beside);
    std::filesystem::rename(beside, file);
  } catch (...) {
    std::filesystem::remove(beside);
    throw;
  }
  fmt::print(streams.out, "{} tables of {} in {}\n", tables.size(), options.study, options.file);
  return 0;
}

}  // namespace irk
