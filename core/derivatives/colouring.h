// Colouring: columns of a Jacobian that share no row are differentiated together, in few evaluations.
#pragma once

#include <cstdint>
#include <vector>

#include "core/derivatives/pattern.h"

namespace irk {

/// Greedy colouring of the column intersection graph: sets of one colour share no row. Gebremedhin,
/// Manne & Pothen, SIAM Review 47 (2005). Returns the colour of each set, from 0 on; `rows`: number of rows.
std::vector<int> colour(const RowSets& sets, Index rows);

/// Directions sorted by colour; those of one colour share no row and are differentiated together. The number
/// colours() stands for one more colour, the check: all directions at a time, each with its weight. The entries of a
/// direction follow one another; large systems have several per unknown, so each takes 8 bytes.
struct ColouredDirections {
  struct Entry {
    int row;             ///< row in the derivative along the direction
    std::uint32_t slot;  ///< its place in the pattern
  };
  Directions directions;
  /// n where each direction is a colour and reaches all n rows of a full pattern; the lists below are then empty.
  Index all_rows = 0;
  std::vector<std::size_t> first_direction;  ///< by colour; colours + 1 numbers
  std::vector<std::uint32_t> first_entry;    ///< by direction that reaches a row, and one number more
  std::vector<Entry> entries;

  ColouredDirections() = default;
  ColouredDirections(const Directions& group, const RowSets& rows, const Pattern& pattern);
  /// The colours that the constructor gives if each direction reaches all n rows: one for each direction.
  static ColouredDirections dense(const Directions& group, Index n) { return {group, n}; }
  std::size_t colours() const {
    if (all_rows > 0) return directions.size();
    return first_direction.empty() ? 0 : first_direction.size() - 1;
  }
  /// The range of directions of a colour; for colour = colours() all directions.
  std::size_t begin(std::size_t colour) const {
    if (colour == colours()) return 0;
    return all_rows > 0 ? colour : first_direction[colour];
  }
  std::size_t end(std::size_t colour) const {
    if (colour == colours()) return directions.size();
    return all_rows > 0 ? colour + 1 : first_direction[colour + 1];
  }
  /// Calls f(row, slot) for the entries of a direction, by ascending rows.
  template <class F>
  void forEachEntry(std::size_t direction, F&& f) const {
    const Index first = directions[direction].column * all_rows;
    for (Index row = 0; row < all_rows; ++row) f(row, first + row);
    if (all_rows > 0) return;
    for (std::uint32_t k = first_entry[direction]; k < first_entry[direction + 1]; ++k) {
      f(Index(entries[k].row), Index(entries[k].slot));
    }
  }
  double weight(std::size_t colour, std::size_t direction) const {
    return colour == colours() ? weightOf(direction) : 1;
  }
  /// The weight of a direction in the check, between 0.5 and 1.5: its number, hashed (Steele, Lea & Flood, OOPSLA 2014,
  /// SplitMix64).
  static double weightOf(std::size_t direction);

 private:
  ColouredDirections(const Directions& group, Index n) : directions(group), all_rows(n) {}
};

}  // namespace irk
