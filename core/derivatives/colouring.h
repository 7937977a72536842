// Few directions instead of all: columns of a Jacobian that share no row are differentiated together.
#pragma once

#include <vector>

#include "core/derivatives/pattern.h"

namespace irk {

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
