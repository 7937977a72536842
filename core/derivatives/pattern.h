// The sparsity pattern of D0, D1 and D2, and the directions along which they are differentiated.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "irk/system.h"

namespace irk {

/// One pattern for D0, D1 and D2, in compressed columns. It is the union of their patterns, so that
/// D0 + mu D1 + mu^2 D2 is a combination of three arrays of values. A full pattern is the dense case:
/// the array of values is then the column-major n x n matrix itself.
struct Pattern {
  Index n = 0;
  bool full = true;
  std::vector<int> column_start;  ///< n + 1 numbers
  std::vector<int> row;           ///< column_start[n] numbers, ascending in each column

  /// The full pattern. Small ones are made once in a process.
  static std::shared_ptr<const Pattern> dense(Index n);
  Index nonzeros() const { return static_cast<Index>(row.size()); }

  /// Calls f(k) for the entries in a block of the matrix.
  template <class F>
  void forEachInBlock(Index first_row, Index rows, Index first_column, Index columns, F&& f) const {
    for (Index j = first_column; j < first_column + columns; ++j) {
      const auto c = static_cast<std::size_t>(j);
      for (int k = column_start[c]; k < column_start[c + 1]; ++k) {
        const Index i = row[static_cast<std::size_t>(k)];
        if (i >= first_row && i < first_row + rows) f(static_cast<Index>(k));
      }
    }
  }

  /// Calls f(k, row) for all entries k, in their order.
  template <class F>
  void forEach(F&& f) const {
    if (!full) {
      for (Index k = 0; k < nonzeros(); ++k) f(k, static_cast<Index>(row[static_cast<std::size_t>(k)]));
      return;
    }
    for (Index j = 0; j < n; ++j) {
      for (Index i = 0; i < n; ++i) f(j * n + i, i);
    }
  }
};

/// Whether values of one pattern fit the other: both are the same object, or both are full and of the same size.
bool sameShape(const std::shared_ptr<const Pattern>& a, const std::shared_ptr<const Pattern>& b);

/// A column of D0, D1 or D2, i.e. the derivative along one component of the point.
struct Direction {
  int matrix;  ///< 0: D0, components of w = (a, k, z); 1: D1, of (v, x); 2: D2, of u
  int column;  ///< in 0..n-1
};
using Directions = std::vector<Direction>;

/// All directions of the first `matrices` of D0, D1, D2, which have n, nu + nx and nu directions.
Directions allDirections(const Sizes& n, int matrices = 3);

/// For each direction the rows where its derivative may differ from zero, ascending. The sets lie in memory one after
/// the other: a system of 1e5 unknowns has 2e5 of them, with a few rows each.
class RowSets {
 public:
  RowSets() = default;
  /// So many empty sets.
  explicit RowSets(std::size_t sets) : start_(sets + 1, 0) {}

  std::size_t size() const { return start_.empty() ? 0 : start_.size() - 1; }
  /// The number of rows of all sets together.
  std::size_t entries() const { return rows_.size(); }
  std::span<const int> operator[](std::size_t i) const {
    return std::span(rows_).subspan(start_[i], start_[i + 1] - start_[i]);
  }
  /// Adds one set after the last.
  void append(std::span<const int> set) {
    if (start_.empty()) start_.push_back(0);
    rows_.insert(rows_.end(), set.begin(), set.end());
    start_.push_back(rows_.size());
  }
  /// Adds all sets of another object after the last.
  void append(const RowSets& others);
  /// Makes room for so many sets and rows of all sets together.
  void reserve(std::size_t sets, std::size_t entries) {
    start_.reserve(sets + 1);
    rows_.reserve(entries);
  }

 private:
  std::vector<std::size_t> start_;  // of each set in rows_; size() + 1 numbers, or none
  std::vector<int> rows_;
};

/// All n rows for each of the directions.
RowSets fullRows(std::size_t directions, Index n);
/// Adds the rows of `more` to `into`. Returns whether `into` has grown.
bool unite(const RowSets& more, RowSets& into);

/// The union of the patterns of D0, D1 and D2.
std::shared_ptr<const Pattern> unionPattern(const Directions& directions, const RowSets& rows, Index n);

}  // namespace irk
