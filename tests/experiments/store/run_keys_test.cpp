#include "experiments/store/run_keys.h"

#include <gtest/gtest.h>

#include <vector>

#include "experiments/base/numbers.h"

namespace irk::store {
namespace {

std::uint64_t keyOf(std::size_t i) { return fnv1a(std::to_string(i)); }

TEST(RunKeys, GiveEachRunOnceWithAllItsBlocks) {
  constexpr std::size_t kRuns = 10;
  // The third series repeats every second run of the first; the second one is left out.
  RunKeys keys({{kRuns, "a"}, {0, "a"}, {kRuns, "b"}});
  std::vector<std::uint64_t> first, third;
  for (std::size_t i = 0; i < kRuns; ++i) {
    first.push_back(keyOf(i));
    third.push_back(keyOf(i % 2 == 0 ? i : kRuns + i));
  }
  keys.set(0, first);
  keys.set(2, third);
  keys.finish();
  EXPECT_TRUE(keys.isLeftOut(1));
  EXPECT_FALSE(keys.isLeftOut(2));
  EXPECT_EQ(keys[0], first);
  EXPECT_EQ(keys[2], third);
  EXPECT_EQ(keys.runs(), kRuns + kRuns / 2);
  std::vector<std::uint64_t> order = first;
  for (std::size_t i = 1; i < kRuns; i += 2) order.push_back(third[i]);
  std::size_t next = 0;
  keys.forEach([&](std::uint64_t key, const std::string& blocks) {
    ASSERT_EQ(key, order[next]);
    ASSERT_EQ(blocks, next >= kRuns ? "b" : next % 2 == 0 ? "a b" : "a") << next;
    ++next;
  });
  EXPECT_EQ(next, order.size());
}

// A run in a series without a block and in others.
TEST(RunKeys, CountARunInThreeSeriesOnce) {
  const std::vector<std::uint64_t> key{keyOf(1)};
  RunKeys keys({{1, ""}, {1, "a"}, {1, "b"}});
  for (const std::size_t series : {0u, 1u, 2u}) keys.set(series, key);
  keys.finish();
  EXPECT_EQ(keys.runs(), 1u);
  std::vector<std::string> given;
  keys.forEach([&given](std::uint64_t, const std::string& blocks) { given.push_back(blocks); });
  EXPECT_EQ(given, std::vector<std::string>{"a b"});
}

}  // namespace
}  // namespace irk::store
