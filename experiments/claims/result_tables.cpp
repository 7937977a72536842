#include "experiments/claims/result_tables.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "experiments/analyses/results.h"
#include "experiments/runs/block_names.h"

namespace irk::claims {
namespace {

// A claim on costs would compare nothing with nothing.
void requireTimes(std::string_view study, const Table& table) {
  const auto refusal = table.hasColumn("cpu_s") ? refusedTimes(table.head) : std::string();
  if (!refusal.empty()) throw MissingResults(fmt::format("study {}: {}", study, refusal));
}

}  // namespace

void ResultTables::put(const std::string& study, const std::string& name, Table table) {
  tables_[study + '/' + name] = std::move(table);
}

std::filesystem::path ResultTables::fileOf(std::string_view study, std::string_view name) const {
  auto file = results_ / study / fmt::format("{}.csv", name);
  if (results_.empty() || !std::filesystem::exists(file)) {
    throw MissingResults(fmt::format("study {} has not been run: no {}.csv", study, name));
  }
  return file;
}

const Table& ResultTables::table(std::string_view study, std::string_view name) const {
  const auto key = fmt::format("{}/{}", study, name);
  const auto found = tables_.find(key);
  if (found != tables_.end()) return found->second;
  Table read = readTable(fileOf(study, name));
  requireTimes(study, read);
  return tables_[key] = std::move(read);
}

Table ResultTables::forEachRun(std::string_view study, const std::function<bool(const std::string& blocks)>& wanted,
                               const std::function<void(const Table& names, TableRow row)>& take) const {
  const auto made_up = tables_.find(fmt::format("{}/runs", study));
  if (made_up != tables_.end()) {
    const Table names{made_up->second.head, made_up->second.columns, {}};
    const auto column = names.column(kBlockColumn);
    for (const auto& row : made_up->second.rows) {
      if (wanted(row[column])) take(names, row);
    }
    return names;
  }
  auto& file = files_[std::string(study)];
  if (!file) file = std::make_shared<GroupedFile>(fileOf(study, "runs"), std::vector{std::string(kBlockColumn)});
  requireTimes(study, file->names());
  std::vector<std::size_t> groups;
  for (std::size_t i = 0; i < file->size(); ++i) {
    if (wanted(file->nameOf(file->firstRow(i)).front())) groups.push_back(i);
  }
  file->forEachRowOf(groups, [&](TableRow row) { take(file->names(), std::move(row)); });
  return file->names();
}

}  // namespace irk::claims
