// Which entries of D0, D1 and D2 can differ from zero, and how few directions give all of them.
#pragma once

#include <memory>
#include <vector>

#include "irk/system.h"

namespace irk {

/// Compressed columns shared by D0, D1 and D2 (the union of their patterns), so that
/// D0 + mu D1 + mu^2 D2 is one combination of three value arrays. A full pattern is the dense case:
/// its value array is the column-major n x n matrix itself.
struct Pattern {
  Index n = 0;
  bool full = true;
  std::vector<int> column_start;  ///< n + 1
  std::vector<int> row;           ///< column_start[n], ascending in each column

  static std::shared_ptr<const Pattern> dense(Index n);
  Index nonzeros() const { return static_cast<Index>(row.size()); }

  /// f(k, row) for all entries k, in their order.
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

/// Whether matrices of one fit the other: the same object, or both full and of one size.
bool sameShape(const std::shared_ptr<const Pattern>& a, const std::shared_ptr<const Pattern>& b);

/// A column of D0, D1 or D2: the derivative along one component of the point.
struct Direction {
  int matrix;    ///< 0: of w = (a, k, z), 1: of (v, x), 2: of u
  Index column;  ///< in 0..n-1
};
using Directions = std::vector<Direction>;

/// All directions that `matrices` of the three have: n of D0, nu + nx of D1, nu of D2.
Directions allDirections(const Sizes& n, int matrices = 3);

/// The rows that each direction reaches, ascending; in the order of the directions.
using RowSets = std::vector<std::vector<int>>;

RowSets fullRows(std::size_t directions, Index n);
/// `into` with the rows of `more` added. Returns whether that was any.
bool unite(const RowSets& more, RowSets& into);

/// The union of the matrices' columns.
std::shared_ptr<const Pattern> unionPattern(const Directions& directions, const RowSets& rows,
                                            Index n);

}  // namespace irk
