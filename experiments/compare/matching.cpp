#include "experiments/compare/matching.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "experiments/base/failure.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run_spec.h"

namespace irk::compare {
namespace {

constexpr std::string_view kAlwaysNamed[] = {"scene", "settings", "method"};
constexpr std::uint64_t kMostGroups = 128;  // each may have a file

bool isAlwaysNamed(std::string_view field) {
  return std::find(std::begin(kAlwaysNamed), std::end(kAlwaysNamed), field) != std::end(kAlwaysNamed);
}

// A text that is the same for equal numbers, regardless of the number of digits in the cell.
std::string plainText(const std::string& cell) {
  const double number = cellNumber(cell);
  return std::isnan(number) ? cell : numberText(number);
}

/// The places of two rows of one run.
struct Match {
  std::optional<std::uint64_t> first, second;
};

}  // namespace

Matching::Matching(const std::filesystem::path& first, const std::filesystem::path& second, std::uint64_t at_once)
    : first_(first), second_(second) {
  const auto bytes = std::filesystem::file_size(first) + std::filesystem::file_size(second);
  const auto groups = std::min(1 + bytes / at_once, kMostGroups);
  findFields();
  for (auto* side : {&first_, &second_}) {
    side->groups.resize(groups);
    readRows(*side);
  }
}

void Matching::findFields() {
  for (const auto& field : specFields()) {
    if (!firstNames().hasColumn(field.name) || !secondNames().hasColumn(field.name)) continue;
    fields_.push_back({std::string(field.name), {}});
    for (auto* side : {&first_, &second_}) side->columns.push_back(side->file.names().column(field.name));
  }
  for (auto* side : {&first_, &second_}) side->cells = side->plain = TableRow(fields_.size());
}

std::string Matching::identity(Side& side, const TableRow& row) {
  std::string text;
  for (std::size_t i = 0; i < side.columns.size(); ++i) {
    const auto& cell = row[side.columns[i]];
    if (cell != side.cells[i]) {
      side.cells[i] = cell;
      side.plain[i] = plainText(cell);
    }
    text.append(side.plain[i]) += '\n';
  }
  return text;
}

void Matching::readRows(Side& side) {
  for (auto position = side.file.position();; position = side.file.position()) {
    const auto row = side.file.next();
    if (!row) break;
    const auto hash = fnv1a(identity(side, *row));
    side.groups[hash % side.groups.size()].add({hash, position});
    const bool is_first = first_.rows + second_.rows == 0;
    ++side.rows;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (is_first) fields_[i].value = side.plain[i];
      if (side.plain[i] != fields_[i].value) fields_[i].varies = true;
    }
  }
}

std::vector<Matching::Place> Matching::sortedGroup(const Side& side, std::size_t group) {
  auto places = side.groups[group].all();
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return std::tie(a.hash, a.position) < std::tie(b.hash, b.position); });
  return places;
}

TableRow Matching::rowAt(Side& side, std::uint64_t position) {
  side.file.seek(position);
  auto row = side.file.next();
  if (!row) throw Failure("a table is shorter than before");
  return std::move(*row);
}

void Matching::visit(std::uint64_t first_at, std::uint64_t second_at, const std::function<void(const Pair&)>& take) {
  const TableRow first = rowAt(first_, first_at), second = rowAt(second_, second_at);
  if (identity(first_, first) != identity(second_, second)) throw Failure("two runs of two tables have the same hash");
  take({&first, &second, first_at, second_at});
}

void Matching::forEachPair(const std::function<void(const Pair&)>& take) {
  for (std::size_t group = 0; group < first_.groups.size(); ++group) {
    std::vector<Match> matches;
    const auto firsts = sortedGroup(first_, group), seconds = sortedGroup(second_, group);
    for (auto a = firsts.begin(), b = seconds.begin(); a != firsts.end() || b != seconds.end();) {
      const bool has_first = a != firsts.end() && (b == seconds.end() || a->hash <= b->hash);
      const bool has_second = b != seconds.end() && (a == firsts.end() || b->hash <= a->hash);
      Match match;
      if (has_first) match.first = (a++)->position;
      if (has_second) match.second = (b++)->position;
      matches.push_back(match);
    }
    // The files are read from their begin to their end.
    std::sort(matches.begin(), matches.end(), [](const Match& a, const Match& b) {
      return std::tuple(!a.first, a.first, a.second) < std::tuple(!b.first, b.first, b.second);
    });
    for (const auto& match : matches) {
      if (match.first && match.second) {
        visit(*match.first, *match.second, take);
      } else if (match.first) {
        const TableRow row = rowAt(first_, *match.first);
        take({&row, nullptr, *match.first, 0});
      } else {
        const TableRow row = rowAt(second_, *match.second);
        take({nullptr, &row, 0, *match.second});
      }
    }
  }
}

std::string Matching::nameOf(const Pair& pair) const {
  std::string name;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const Field& field = fields_[i];
    const std::string& cell = pair.first ? (*pair.first)[first_.columns[i]] : (*pair.second)[second_.columns[i]];
    const bool always = isAlwaysNamed(field.name);
    if (cell.empty() || !(always || field.varies)) continue;
    name += fmt::format("{}{}{}", name.empty() ? "" : " ", always ? "" : field.name + "=", plainText(cell));
  }
  return name;
}

}  // namespace irk::compare
