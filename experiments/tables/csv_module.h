// Tables in CSV files as virtual tables of SQLite.
#pragma once

#include <exception>
#include <filesystem>
#include <memory>
#include <string>

struct sqlite3;

namespace irk {

/// A name of a table or column as SQL has it, whatever its characters.
std::string quotedName(const std::string& name);

/// See Database::addFile. What reading the file throws is kept in `thrown`, and the query fails. Returns a status of
/// SQLite.
int addCsvModule(sqlite3* database, const std::string& name, const std::filesystem::path& file,
                 std::shared_ptr<std::exception_ptr> thrown);

}  // namespace irk
