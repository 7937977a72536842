#include "experiments/tables/grouped_file.h"

#include <algorithm>
#include <map>
#include <utility>

#include "experiments/base/failure.h"
#include "experiments/base/numbers.h"

namespace irk {
namespace {

// Different names with equal hashes are detected when their rows are read.
std::uint64_t groupHash(const TableRow& name) {
  std::string text;
  for (const auto& cell : name) text.append(cell) += '\0';
  return fnv1a(text);
}

}  // namespace

GroupedFile::GroupedFile(const std::filesystem::path& file, const std::vector<std::string>& columns)
    : file_(file), start_(file_.position()) {
  for (const auto& column : columns) cells_.push_back(names().column(column));
  std::uint64_t begin = start_;
  while (const auto row = file_.next()) {
    const auto next = static_cast<std::uint32_t>(numbers_.size());
    places_.push_back({numbers_.try_emplace(groupHash(nameOf(*row)), next).first->second, begin});
    begin = file_.position();
  }
  std::stable_sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) { return a.group < b.group; });
}

TableRow GroupedFile::nameOf(const TableRow& row) const {
  TableRow name;
  name.reserve(cells_.size());
  for (const std::size_t cell : cells_) name.push_back(row[cell]);
  return name;
}

std::span<const GroupedFile::Place> GroupedFile::placesOf(std::size_t group) const {
  const auto of = std::ranges::equal_range(places_, static_cast<std::uint32_t>(group), {}, &Place::group);
  return {of.begin(), of.end()};
}

TableRow GroupedFile::firstRow(std::size_t i) const {
  file_.seek(placesOf(i).front().begin);
  return file_.next().value();
}

std::vector<TableRow> GroupedFile::group(std::size_t i) const {
  std::vector<TableRow> rows;
  forEachRowOf({i}, [&rows](TableRow row) { rows.push_back(std::move(row)); });
  return rows;
}

void GroupedFile::forEachRowOf(const std::vector<std::size_t>& groups,
                               const std::function<void(TableRow row)>& take) const {
  std::vector<Place> places;
  for (const std::size_t i : groups) {
    const auto its = placesOf(i);
    places.insert(places.end(), its.begin(), its.end());
  }
  std::ranges::sort(places, {}, &Place::begin);
  std::map<std::uint32_t, TableRow> names;
  for (const auto& place : places) {
    file_.seek(place.begin);
    auto row = file_.next().value();
    auto name = nameOf(row);
    const auto& first = names.try_emplace(place.group, name).first->second;
    if (name != first) throw Failure("two groups of one table have the same hash");
    take(std::move(row));
  }
}

void GroupedFile::forEachRow(const std::function<void(const TableRow&)>& take) const {
  file_.seek(start_);
  while (const auto row = file_.next()) take(*row);
}

std::optional<std::size_t> GroupedFile::find(const TableRow& name) const {
  const auto at = numbers_.find(groupHash(name));
  return at == numbers_.end() ? std::nullopt : std::optional<std::size_t>(at->second);
}

}  // namespace irk
