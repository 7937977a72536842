#include "experiments/compare/matching.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <tuple>

#include "experiments/base/failure.h"
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
std::string plainText(const std::string& cell) {
  const double number = cellNumber(cell);
  return std::isnan(number) ? cell : numberText(number);
}

constexpr std::uint64_t kNoRow = ~std::uint64_t{0};

/// The places of two rows of one run. The first table's order, behind it what only the second one has.
struct Match {
  std::uint64_t first = kNoRow, second = kNoRow;
  auto operator<=>(const Match&) const = default;
};

}  // namespace

Matching::Matching(const std::filesystem::path& first, const std::filesystem::path& second)
    : first_(first), second_(second) {
  findFields();
  readRows(first_);
  readRows(second_);
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
    const std::uint64_t hash = fnv1a(identity(side, *row));
    const bool is_first = first_.places.empty() && second_.places.empty();
    side.places.push_back({hash, position});
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (is_first) fields_[i].value = side.plain[i];
      if (side.plain[i] != fields_[i].value) fields_[i].varies = true;
    }
  }
  std::sort(side.places.begin(), side.places.end(),
            [](const Place& a, const Place& b) { return std::tie(a.hash, a.position) < std::tie(b.hash, b.position); });
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
  const auto &firsts = first_.places, &seconds = second_.places;
  std::vector<Match> matches;
  for (auto a = firsts.begin(), b = seconds.begin(); a != firsts.end() || b != seconds.end();) {
    const bool has_first = a != firsts.end() && (b == seconds.end() || a->hash <= b->hash);
    const bool has_second = b != seconds.end() && (a == firsts.end() || b->hash <= a->hash);
    Match match;
    if (has_first) match.first = (a++)->position;
    if (has_second) match.second = (b++)->position;
    matches.push_back(match);
  }
  std::sort(matches.begin(), matches.end());
  for (const auto& [first, second] : matches) {
    if (first != kNoRow && second != kNoRow) {
      visit(first, second, take);
    } else if (first != kNoRow) {
      const TableRow row = rowAt(first_, first);
      take({&row, nullptr, first, 0});
    } else {
      const TableRow row = rowAt(second_, second);
      take({nullptr, &row, 0, second});
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
