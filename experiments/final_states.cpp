#include "experiments/final_states.h"

#include <iterator>
#include <sstream>

#include "experiments/numbers.h"
#include "experiments/run_table.h"

namespace irk {

Vec<double> componentsOf(const RunRecord& record) {
  Vec<double> y(record.u.size() + record.v.size() + record.x.size() + record.z.size());
  y << record.u, record.v, record.x, record.z;
  return y;
}

std::string vectorText(const Vec<double>& y) {
  std::string text;
  for (const double value : y) text += (text.empty() ? "" : " ") + numberText(value);
  return text;
}

Vec<double> parseVector(const std::string& text) {
  std::istringstream in(text);
  std::vector<double> numbers;
  for (std::string word; in >> word;) numbers.push_back(cellNumber(word));
  return Eigen::Map<const Vec<double>>(numbers.data(), static_cast<Index>(numbers.size()));
}

FinalStates::FinalStates(const std::filesystem::path& file, const TableHead& head, bool fresh) {
  Table table{head, {"key", "state"}, {}};
  if (!fresh && std::filesystem::exists(file)) {
    const Table found = readTable(file);
    if (found.columns == table.columns) table.rows = found.rows;
  }
  for (const auto& row : table.rows) states_[row[0]] = row[1];
  writer_.emplace(file, table);
}

void FinalStates::append(const std::string& key, const RunRecord& record) {
  const auto& state = states_[key] = vectorText(componentsOf(record));
  writer_->append({key, state});
}

Table mergedStates(const std::vector<std::string>& folders) {
  Table merged;
  for (const auto& folder : folders) {
    Table table = readTable(std::filesystem::path(folder) / "states.csv");
    if (merged.columns.empty()) merged = {table.head, table.columns, {}};
    std::move(table.rows.begin(), table.rows.end(), std::back_inserter(merged.rows));
  }
  return merged;
}

std::map<std::string, Vec<double>> readStates(const std::filesystem::path& file) {
  std::map<std::string, Vec<double>> states;
  const Table table = readTable(file);
  for (const auto& row : table.rows) {
    states[textAt(table, row, "key")] = parseVector(textAt(table, row, "state"));
  }
  return states;
}

}  // namespace irk
