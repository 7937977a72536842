// The rows of a table in a file by the cells of some columns, so that the table may be larger than the memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "experiments/tables/table_rows.h"

namespace irk {

/// A group is all rows with the same cells in these columns, its name. Groups are in the order of their first rows.
/// Memory holds 16 bytes per row, about 45 per group, and the rows in use. Not thread-safe. Throws what readTable
/// throws, and Failure if two names have the same hash.
class GroupedFile {
 public:
  /// Reads the file once. Throws Misuse for an unknown column.
  GroupedFile(const std::filesystem::path& file, const std::vector<std::string>& columns);

  /// Head and columns, no rows.
  const Table& names() const { return file_.names(); }
  std::size_t rows() const { return places_.size(); }
  /// Visits all rows in the order of the file.
  void forEachRow(const std::function<void(const TableRow&)>& take) const;

  /// The number of groups.
  std::size_t size() const { return numbers_.size(); }
  /// The number of the group with this name.
  std::optional<std::size_t> find(const TableRow& name) const;
  /// The name of the group that the row belongs to.
  TableRow nameOf(const TableRow& row) const;
  /// The first row of group i.
  TableRow firstRow(std::size_t i) const;
  /// The rows of group i, in the order of the file.
  std::vector<TableRow> group(std::size_t i) const;
  /// Visits the rows of some groups in the order of the file.
  void forEachRowOf(const std::vector<std::size_t>& groups, const std::function<void(TableRow row)>& take) const;

 private:
  /// Where a row begins.
  struct Place {
    std::uint32_t group;
    std::uint64_t begin;
  };
  std::span<const Place> placesOf(std::size_t group) const;

  mutable TableFile file_;
  std::uint64_t start_;                                       // of the first row
  std::vector<std::size_t> cells_;                            // places of the columns in a row
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;  // of groups, by the hashes of their names
  std::vector<Place> places_;                                 // by group, then in the order of the file
};

}  // namespace irk
