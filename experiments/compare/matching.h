// Matches rows of two tables that stand for the same run.
#pragma once

#include <string>
#include <vector>

#include "experiments/tables/table.h"

namespace irk::compare {

/// The rows of a run in two tables; null if a table does not have it.
struct Pair {
  const TableRow* first;
  const TableRow* second;
};

/// Matches the runs of two tables by the fields of a spec that both have. Numbers are compared by value: 0.1 equals
/// 0.10000000000000001, as older tables write it. Rows with equal fields are matched in their order. Keeps references
/// to the tables, which must outlive it.
class Matching {
 public:
  Matching(const Table& first, const Table& second);

  /// The runs in the order of the first table, then those that only the second one has.
  const std::vector<Pair>& pairs() const { return pairs_; }
  /// Scene, settings and method, then `field=value` for all other fields that vary between runs.
  std::string nameOf(const Pair& pair) const;

 private:
  /// The columns of a field in both tables.
  struct Field {
    std::string name;
    std::size_t first, second;
    bool varies = false;
  };
  void findFields();
  void findPairs();
  void findVarying();
  std::string identity(const TableRow& row, std::size_t Field::*column) const;

  const Table& first_;
  const Table& second_;
  std::vector<Field> fields_;
  std::vector<Pair> pairs_;
};

}  // namespace irk::compare
