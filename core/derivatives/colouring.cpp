#include "core/derivatives/colouring.h"

#include <algorithm>
#include <numeric>

namespace irk {

std::vector<int> colour(const RowSets& sets, Index rows) {
  // The colours in use at each row, stored one row after the other, with room for one colour of each set there.
  std::vector<std::size_t> begin(static_cast<std::size_t>(rows) + 1, 0);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (const int row : sets[i]) ++begin[static_cast<std::size_t>(row) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
  std::vector<int> at_row(begin.back());
  std::vector<int> colours(sets.size(), 0);
  std::vector<std::size_t> used_by;  // by colour: 1 + the last set that cannot have it
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (const int row : sets[i]) {
      const auto r = static_cast<std::size_t>(row);
      for (std::size_t k = begin[r]; k < end[r]; ++k) {
        used_by[static_cast<std::size_t>(at_row[k])] = i + 1;
      }
    }
    std::size_t free = 0;
    while (free < used_by.size() && used_by[free] == i + 1) ++free;
    if (free == used_by.size()) used_by.push_back(0);
    colours[i] = static_cast<int>(free);
    for (const int row : sets[i]) at_row[end[static_cast<std::size_t>(row)]++] = colours[i];
  }
  return colours;
}

ColouredDirections::ColouredDirections(const Directions& group, const RowSets& rows, const Pattern& pattern) {
  const std::vector<int> colours = colour(rows, pattern.n);
  std::vector<std::uint32_t> order(group.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return colours[a] < colours[b]; });
  directions.reserve(group.size());
  first_entry.reserve(group.size() + 1);
  entries.reserve(rows.entries());
  int last = -1;
  for (const std::size_t i : order) {
    if (rows[i].empty()) continue;
    if (colours[i] != last) {
      first_direction.push_back(directions.size());
      last = colours[i];
    }
    directions.push_back(group[i]);
    first_entry.push_back(static_cast<std::uint32_t>(entries.size()));
    const auto column = static_cast<std::size_t>(group[i].column);
    auto at = pattern.row.begin() + pattern.column_start[column];
    for (const int row : rows[i]) {
      at = std::lower_bound(at, pattern.row.begin() + pattern.column_start[column + 1], row);
      entries.push_back({row, static_cast<std::uint32_t>(at - pattern.row.begin())});
    }
  }
  first_direction.push_back(directions.size());
  first_entry.push_back(static_cast<std::uint32_t>(entries.size()));
  for (const std::size_t i : order) {  // directions that reach no row take part in the check only
    if (rows[i].empty()) directions.push_back(group[i]);
  }
}

double ColouredDirections::weightOf(std::size_t direction) {
  std::uint64_t z = (direction + 1) * 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  z ^= z >> 31U;
  return 0.5 + static_cast<double>(z >> 11U) * 0x1p-53;
}

}  // namespace irk
