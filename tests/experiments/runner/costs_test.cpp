// Expected costs of series: from earlier rows where there are any; shards that all jobs of an array agree on.
#include "experiments/runner/schedule/costs.h"

#include <gtest/gtest.h>

#include <fstream>

#include "experiments/runner/shard_plan.h"
#include "tests/experiments/stored_runs.h"
#include "tests/refusal.h"

namespace irk {
namespace {

constexpr char kSix[] = R"(
[[block]]
scene = ["kepler", "van_der_pol"]
t_end = 0.1
methods = ["radau_iia_2", "radau_iia_3", "gauss_2"]
tolerances = [1e-3, 1e-4]
)";

class ExpectedCosts : public StoredRuns {
 protected:
  // Makes the study's runs and gives them these times, by series.
  void runWithTimes(const std::vector<double>& seconds) {
    run("results", {}, kSix);
    const Study six = study(kSix);
    changePart("results", [&](Table& part) {
      for (auto& row : part.rows) {
        for (std::size_t i = 0; i < six.series.size(); ++i) {
          const auto keys = keysOf(six.series[i]);
          const bool its = std::find(keys.begin(), keys.end(), store::keyNumber(row.front())) != keys.end();
          if (its) row[part.column("cpu_s")] = std::to_string(seconds[i]);
        }
      }
    });
  }
  std::vector<double> costs(const Study& of) {
    const Store earlier = reader();
    return Costs(
               of, [&](std::size_t i) { return keysOf(of.series[i]); }, earlier.runs())
        .sums();
  }
};

TEST_F(ExpectedCosts, AreGuessedWithoutRows) {
  const Study six = study(kSix);
  const auto guessed = costs(six);
  ASSERT_EQ(guessed.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(guessed[i], expectedCost(six.series[i]));
}

TEST_F(ExpectedCosts, AreTheTimesOfEarlierRows) {
  const std::vector<double> seconds{1, 2, 4, 10, 20, 40};
  runWithTimes(seconds);
  const auto known = costs(study(kSix));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(known[i], 2 * seconds[i]) << "two runs each";
  // Rows of other code count, too.
  changePart("results", [](Table& part) {
    for (auto& row : part.rows) row[part.column("code")] = "other";
  });
  EXPECT_EQ(costs(study(kSix)), known);

  // A new tolerance takes the mean of its series; a new method its guess, scaled to the seconds of its scene.
  std::string more = kSix;
  more.replace(more.find("1e-4]"), 5, "1e-4, 1e-5]");
  more.replace(more.find("\"gauss_2\"]"), 10, "\"gauss_2\", \"gauss_5\"]");
  const Study larger = study(more);
  const auto mixed = costs(larger);
  ASSERT_EQ(mixed.size(), 8u);
  EXPECT_DOUBLE_EQ(mixed[0], 3 * seconds[0]);
  const auto guess = [&](std::size_t i) { return expectedCost(larger.series[i]); };
  EXPECT_DOUBLE_EQ(mixed[3], guess(3) * (3 * 7) / (guess(0) + guess(1) + guess(2)));
  EXPECT_DOUBLE_EQ(mixed[7], guess(7) * (3 * 70) / (guess(4) + guess(5) + guess(6)));
}

TEST_F(ExpectedCosts, BalanceTheShards) {
  runWithTimes({1, 1, 1, 1, 1, 5});
  RunnerOptions half = options();
  half.shard = {1, 2};
  EXPECT_EQ(shardsOf(study(kSix), half), (std::vector<int>{2, 2, 2, 2, 2, 1}));
}

// A job of the array that starts after others have been merged must not use other shards than they did.
TEST_F(ExpectedCosts, ThePlanOfTheFirstJobStays) {
  runWithTimes({1, 1, 1, 1, 1, 5});
  RunnerOptions half = options();
  half.shard = {1, 2};
  const auto plan = shardsOf(study(kSix), half);
  keepShards(study(kSix), half);
  runWithTimes({5, 1, 1, 1, 1, 1});
  EXPECT_EQ(shardsOf(study(kSix), half), plan);
  keepShards(study(kSix), half);
  EXPECT_EQ(shardsOf(study(kSix), half), plan);
  // Another number of shards and another study have plans of their own.
  half.shard = {1, 3};
  EXPECT_NE(shardsOf(study(kSix), half), plan);
  half.shard = {1, 2};
  std::string edited = kSix;
  edited.replace(edited.find("t_end = 0.1"), 11, "t_end = 0.2");
  EXPECT_NE(shardsOf(study(edited), half), plan);
  keepShards(study(edited), half);
  // A damaged plan is none.
  std::ofstream(folder() / "shards_of_2", std::ios::app) << "3\n";
  EXPECT_EQ(shardsOf(study(edited), half).size(), 6u);
  // Nor is a device, which may have no end.
  std::filesystem::remove(folder() / "shards_of_2");
  std::filesystem::create_symlink("/dev/null", folder() / "shards_of_2");
  const auto message = refusal([&] { shardsOf(study(edited), half); });
  EXPECT_TRUE(containsAll(message, {"shards_of_2", "a device", "regular file"})) << message;
}

}  // namespace
}  // namespace irk
