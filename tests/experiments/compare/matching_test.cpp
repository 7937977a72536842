// Rows of two tables that stand for the same run.
#include "experiments/compare/matching.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "experiments/runs/run_table.h"
#include "tests/experiments/support.h"

namespace irk::compare {
namespace {

// Some runs are in one table only, some occur twice, and the second table is ordered differently.
TEST(Matching, FindsEachRunInBothTables) {
  Table first{{}, {"scene", "method", "h", "residuals"}, {}};
  for (int i = 0; i < 9000; ++i) {
    first.rows.push_back({"kepler", "gauss_2", std::to_string(i), std::to_string(i)});
    if (i % 1000 == 0) first.rows.push_back(first.rows.back());
  }
  Table second = first;
  std::shuffle(second.rows.begin(), second.rows.end(), std::mt19937(3));
  first.rows.push_back({"kepler", "gauss_2", "-7", "0"});
  second.rows.push_back({"kepler", "gauss_2", "-8", "0"});
  const TemporaryFolder folder;
  const auto a = folder.path() / "first.csv", b = folder.path() / "second.csv";
  writeTable(a, first);
  writeTable(b, second);
  Matching matching(a, b);
  std::size_t both = 0;
  std::uint64_t before = 0;
  std::vector<std::string> only;
  matching.forEachPair([&](const Pair& pair) {
    if (!pair.first || !pair.second) {
      only.push_back((pair.first ? "first " : "second ") + matching.nameOf(pair));
    } else {
      ++both;
      ASSERT_EQ(*pair.first, *pair.second);
      EXPECT_GE(pair.order(), before) << "in the order of the first table";
      before = pair.order();
    }
  });
  EXPECT_EQ(both, 9009u);
  EXPECT_EQ(only, (std::vector<std::string>{"first kepler gauss_2 h=-7", "second kepler gauss_2 h=-8"}));
}

}  // namespace
}  // namespace irk::compare
