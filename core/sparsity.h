// Which entries of D0, D1 and D2 can differ from zero, and how few directions give all of them.
#pragma once

#include <memory>
#include <vector>

#include "core/system.h"

namespace irk {

/// How D0, D1, D2 and the Newton matrices are kept.
enum class Storage {
  kAutomatic,  ///< sparse where the system is large and its pattern sparse enough; linearization.h
  kDense,
  kSparse,
};

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

/// The rows where derivatives differ from zero at a point near p, by dual numbers in random
/// combinations: intervals of columns are halved thrice at a time, those that share no row together,
/// so that about log8(n) times the colours of the pattern are evaluated. Near p: a derivative that
/// happens to vanish at p is found. `at_p`: and at p itself, which costs as much again. What is not
/// finite is not counted.
template <class Real>
RowSets detectRows(const System<Real>& system, Level level, const Point<Real>& p,
                   const Directions& directions, bool at_p);

/// Greedy colouring of the column intersection graph: sets of one colour share no row. Gebremedhin,
/// Manne & Pothen, SIAM Review 47 (2005). Returns the colour of each set.
std::vector<int> colour(const RowSets& sets, Index rows);

/// Directions to be differentiated together: those of one colour share no row.
struct ColouredDirections {
  struct Entry {
    int row;                ///< of the derivative along a colour
    int matrix;             ///< whose value it is, ...
    Index slot;             ///< ... where in the pattern, ...
    std::size_t direction;  ///< ... and in which of the directions
  };
  Directions directions;
  std::vector<double> weights;  ///< of the directions, random around 1: a combination for checks
  std::vector<std::size_t> first_direction, first_entry;  ///< colours + 1
  std::vector<Entry> entries;

  ColouredDirections() = default;
  ColouredDirections(const Directions& group, const RowSets& rows, const Pattern& pattern);
  std::size_t colours() const { return first_direction.empty() ? 0 : first_direction.size() - 1; }
  /// The directions of a colour; of `colours()`: all, with their weights.
  std::size_t begin(std::size_t colour) const {
    return colour == colours() ? 0 : first_direction[colour];
  }
  std::size_t end(std::size_t colour) const {
    return colour == colours() ? directions.size() : first_direction[colour + 1];
  }
  double weight(std::size_t colour, std::size_t direction) const {
    return colour == colours() ? weights[direction] : 1;
  }
};

}  // namespace irk
