#include "experiments/compare/matching.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "experiments/base/numbers.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run_spec.h"

namespace irk::compare {
namespace {

constexpr std::string_view kAlwaysNamed[] = {"scene", "settings", "method"};

bool isAlwaysNamed(std::string_view field) {
  return std::find(std::begin(kAlwaysNamed), std::end(kAlwaysNamed), field) != std::end(kAlwaysNamed);
}

// A text that is the same for equal numbers, regardless of the number of digits in the cell.
std::string plain(const std::string& cell) {
  const double number = cellNumber(cell);
  return std::isnan(number) ? cell : numberText(number);
}

}  // namespace

Matching::Matching(const Table& first, const Table& second) : first_(first), second_(second) {
  findFields();
  findPairs();
  findVarying();
}

void Matching::findFields() {
  for (const auto& field : specFields()) {
    if (!first_.hasColumn(field.name) || !second_.hasColumn(field.name)) continue;
    fields_.push_back({std::string(field.name), first_.column(field.name), second_.column(field.name)});
  }
}

std::string Matching::identity(const TableRow& row, std::size_t Field::*column) const {
  std::string text;
  for (const auto& field : fields_) text += plain(row[field.*column]) + '\n';
  return text;
}

void Matching::findPairs() {
  std::map<std::string, std::vector<const TableRow*>> others;  // taken from the back
  for (auto row = second_.rows.rbegin(); row != second_.rows.rend(); ++row) {
    others[identity(*row, &Field::second)].push_back(&*row);
  }
  std::set<const TableRow*> taken;
  for (const auto& row : first_.rows) {
    const auto found = others.find(identity(row, &Field::first));
    const TableRow* other = nullptr;
    if (found != others.end() && !found->second.empty()) {
      other = found->second.back();
      found->second.pop_back();
      taken.insert(other);
    }
    pairs_.push_back({&row, other});
  }
  for (const auto& row : second_.rows) {
    if (!taken.contains(&row)) pairs_.push_back({nullptr, &row});
  }
}

void Matching::findVarying() {
  for (auto& field : fields_) {
    std::set<std::string> values;
    for (const auto& pair : pairs_) {
      values.insert(plain(pair.first ? (*pair.first)[field.first] : (*pair.second)[field.second]));
      if (values.size() > 1) break;
    }
    field.varies = values.size() > 1;
  }
}

std::string Matching::nameOf(const Pair& pair) const {
  std::string name;
  for (const auto& field : fields_) {
    const std::string& cell = pair.first ? (*pair.first)[field.first] : (*pair.second)[field.second];
    const bool always = isAlwaysNamed(field.name);
    if (cell.empty() || !(always || field.varies)) continue;
    name += fmt::format("{}{}{}", name.empty() ? "" : " ", always ? "" : field.name + "=", plain(cell));
  }
  return name;
}

}  // namespace irk::compare
