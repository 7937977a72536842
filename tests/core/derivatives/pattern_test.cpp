// Sets of rows, their colours, and the directions of a full pattern.
#include "core/derivatives/pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "core/derivatives/colouring.h"

namespace irk {
namespace {

TEST(Pattern, ColoursOfOneRowDiffer) {
  std::minstd_rand random(5);
  std::uniform_int_distribution<int> row(0, 39);
  RowSets sets;
  for (int i = 0; i < 60; ++i) {
    std::set<int> rows;
    for (int k = 0; k < 3; ++k) rows.insert(row(random));
    sets.append(std::vector<int>(rows.begin(), rows.end()));
  }
  const std::vector<int> colours = colour(sets, 40);
  std::set<std::pair<int, int>> taken;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (const int r : sets[i]) EXPECT_TRUE(taken.insert({r, colours[i]}).second);
  }
  EXPECT_LT(*std::max_element(colours.begin(), colours.end()), 20);
}

TEST(Pattern, DenseDirectionsAreThoseOfAFullPattern) {
  const Sizes n{.nu = 3, .nx = 2, .nz = 1};
  const Directions group = allDirections(n);
  const ColouredDirections fast = ColouredDirections::dense(group, n.n());
  const ColouredDirections slow(group, fullRows(group.size(), n.n()), *Pattern::dense(n.n()));
  ASSERT_EQ(fast.colours(), slow.colours());
  for (std::size_t colour = 0; colour <= slow.colours(); ++colour) {
    EXPECT_EQ(fast.begin(colour), slow.begin(colour));
    EXPECT_EQ(fast.end(colour), slow.end(colour));
  }
  ASSERT_EQ(fast.directions.size(), slow.directions.size());
  for (std::size_t i = 0; i < slow.directions.size(); ++i) {
    EXPECT_EQ(fast.directions[i].matrix, slow.directions[i].matrix);
    EXPECT_EQ(fast.directions[i].column, slow.directions[i].column);
  }
  const auto entriesOf = [](const ColouredDirections& coloured, std::size_t direction) {
    std::vector<std::pair<Index, Index>> entries;
    coloured.forEachEntry(direction, [&](Index row, Index slot) { entries.emplace_back(row, slot); });
    return entries;
  };
  for (std::size_t i = 0; i < group.size(); ++i) {
    EXPECT_EQ(entriesOf(slow, i).size(), 6u);
    EXPECT_EQ(entriesOf(fast, i), entriesOf(slow, i));
  }
}

TEST(Pattern, RowSetsKeepTheirOrder) {
  RowSets sets(2);  // two empty ones
  sets.append(std::vector{3, 5});
  RowSets more;
  more.append(std::vector{1, 4});
  more.append(std::vector<int>());
  sets.append(more);
  ASSERT_EQ(sets.size(), 5u);
  EXPECT_EQ(sets.entries(), 4u);
  const auto rows = [&](std::size_t i) { return std::vector<int>(sets[i].begin(), sets[i].end()); };
  EXPECT_EQ(rows(1), std::vector<int>());
  EXPECT_EQ(rows(2), (std::vector{3, 5}));
  EXPECT_EQ(rows(3), (std::vector{1, 4}));
  EXPECT_EQ(rows(4), std::vector<int>());

  RowSets other(4);
  other.append(std::vector{2});
  EXPECT_TRUE(unite(other, sets));
  EXPECT_EQ(rows(2), (std::vector{3, 5}));
  EXPECT_EQ(rows(4), std::vector{2});
  EXPECT_FALSE(unite(other, sets));
}

}  // namespace
}  // namespace irk
