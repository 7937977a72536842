// Expected costs of series: from earlier rows where there are any.
#include "experiments/runner/schedule/costs.h"

#include <gtest/gtest.h>

#include <numeric>

#include "experiments/runner/series_keys.h"
#include "tests/experiments/stored_runs.h"

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
  // The sums over the runs of all series.
  std::vector<double> costs(const Study& of) {
    const Store earlier = reader();
    const Costs expected(
        of, [&](std::size_t i) { return keysOf(of.series[i]); }, earlier.runs());
    std::vector<double> sums;
    for (std::size_t i = 0; i < of.series.size(); ++i) {
      const auto runs = expected.of(i);
      sums.push_back(std::accumulate(runs.begin(), runs.end(), 0.0));
    }
    return sums;
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

}  // namespace
}  // namespace irk
