// Matches rows of two tables that stand for the same run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/tables/table_rows.h"

namespace irk::compare {

/// The rows of a run in two tables; null if a table does not have it.
struct Pair {
  const TableRow* first = nullptr;
  const TableRow* second = nullptr;
  std::uint64_t first_at = 0, second_at = 0;  ///< where they begin, in bytes

  /// Orders pairs as the first table does, and behind them those that only the second one has.
  std::uint64_t order() const { return first ? first_at : (std::uint64_t{1} << 63) + second_at; }
};

/// Matches the runs of two tables by the fields of a spec that both have. Numbers are compared by value: 0.1 equals
/// 0.10000000000000001, as older tables write it. Rows with equal fields are matched in their order. Reads both files
/// once, and again for the pairs. Memory holds 16 bytes per row, and 16 more per pair while pairs are visited. Not
/// thread-safe. Throws what readTable throws.
class Matching {
 public:
  Matching(const std::filesystem::path& first, const std::filesystem::path& second);

  /// Head and columns, no rows.
  const Table& firstNames() const { return first_.file.names(); }
  const Table& secondNames() const { return second_.file.names(); }
  std::size_t firstRows() const { return first_.places.size(); }
  std::size_t secondRows() const { return second_.places.size(); }

  /// Visits all pairs in the order of the first table. Throws Failure if the hashes of two different runs are equal.
  void forEachPair(const std::function<void(const Pair&)>& take);
  /// Visits the pair whose rows begin there.
  void visit(std::uint64_t first_at, std::uint64_t second_at, const std::function<void(const Pair&)>& take);
  /// Scene, settings and method, then `field=value` for all other fields that vary between runs.
  std::string nameOf(const Pair& pair) const;

 private:
  struct Place {
    std::uint64_t hash, position;
  };
  /// One of the two tables.
  struct Side {
    explicit Side(const std::filesystem::path& path) : file(path) {}

    TableFile file;
    std::vector<Place> places;         // of all rows, sorted
    std::vector<std::size_t> columns;  // of fields_
    TableRow cells, plain;             // of fields_ in the row that was read last, and as `identity` has them
  };
  struct Field {
    std::string name;
    std::string value;  // in the first row
    bool varies = false;
  };
  void findFields();
  void readRows(Side& side);
  static std::string identity(Side& side, const TableRow& row);
  static TableRow rowAt(Side& side, std::uint64_t position);

  Side first_, second_;
  std::vector<Field> fields_;
};

}  // namespace irk::compare
