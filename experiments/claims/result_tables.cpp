#include "experiments/claims/result_tables.h"

#include <fmt/format.h>

#include <utility>

#include "experiments/analyses/results.h"

namespace irk::claims {

void ResultTables::put(const std::string& study, const std::string& name, Table table) {
  tables_[study + '/' + name] = std::move(table);
}

const Table& ResultTables::table(std::string_view study, std::string_view name) const {
  const auto key = fmt::format("{}/{}", study, name);
  const auto found = tables_.find(key);
  if (found != tables_.end()) return found->second;
  const auto file = results_ / study / fmt::format("{}.csv", name);
  if (results_.empty() || !std::filesystem::exists(file)) {
    throw MissingResults(fmt::format("study {} has not been run: no {}.csv", study, name));
  }
  Table read = readTable(file);
  // Without times a claim about costs would compare nothing.
  const auto refusal = read.hasColumn("cpu_s") ? refusedTimes(read.head) : std::string();
  if (!refusal.empty()) throw MissingResults(fmt::format("study {}: {}", study, refusal));
  return tables_[key] = std::move(read);
}

}  // namespace irk::claims
