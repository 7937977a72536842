// Which rows of two tables stand for the same run.
#pragma once

#include <string>
#include <vector>

#include "experiments/tables/table.h"

namespace irk::compare {

/// Rows of two tables, null where one has no such run.
struct Pair {
  const TableRow* first;
  const TableRow* second;
};

/// The runs of two tables by the fields of a spec that both have. Numbers are compared as numbers: 0.1 is
/// 0.10000000000000001, as older tables have it. Rows with equal fields are matched in their order. Keeps references to
/// the tables.
class Matching {
 public:
  Matching(const Table& first, const Table& second);

  /// In the order of the first table, then those of the second one only.
  const std::vector<Pair>& pairs() const { return pairs_; }
  /// Scene, settings and method, then `field=value` of the other fields that are not the same in all runs.
  std::string nameOf(const Pair& pair) const;

 private:
  /// A field's column in both tables.
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
