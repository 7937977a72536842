// Calibrations beside timed runs show hosts whose speed changes.
#include "experiments/store/calibration.h"

#include <gtest/gtest.h>

#include <fstream>

#include "experiments/analyses/results.h"
#include "experiments/runner/timing.h"
#include "tests/experiments/stored_runs.h"

namespace irk::store {
namespace {

std::vector<double> even(std::size_t count, double seconds) {
  std::vector<double> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back(seconds * (1 + 0.01 * static_cast<double>(i % 5)));
  return all;
}

std::vector<double> withSlow(std::vector<double> all, std::size_t slow, double factor) {
  for (std::size_t i = 0; i < slow; ++i) all[i] *= factor;
  return all;
}

TEST(Calibration, DoubtsHostsThatDrift) {
  EXPECT_EQ(calibrationDoubts({}), "");
  EXPECT_EQ(calibrationDoubts({{"n1", "cpu", even(50, 1e-3)}, {"n2", "cpu", even(50, 1.02e-3)}}), "");
  EXPECT_EQ(calibrationDoubts({{"n1", "cpu", withSlow(even(50, 1e-3), 4, 1.5)}}), "") << "a few disturbances";
  const auto drift =
      calibrationDoubts({{"n1", "cpu", withSlow(even(50, 1e-3), 20, 1.5)}, {"n2", "cpu", even(9, 1e-3)}});
  EXPECT_TRUE(containsAll(drift, {"40 %", "n1", "1.1", "up to 1.5"})) << drift;
  EXPECT_EQ(drift.find("n2"), drift.npos);
}

TEST(Calibration, DoubtsHostsSlowerThanOthersOfTheirKind) {
  const auto slow = calibrationDoubts({{"n1", "cpu", even(50, 1e-3)}, {"n2", "cpu", even(50, 1.3e-3)}});
  EXPECT_TRUE(containsAll(slow, {"n2", "1.30 times slower", "same processor"}) ||
              containsAll(slow, {"n2 is 1.30 times slower"}))
      << slow;
  EXPECT_EQ(slow.find("n1"), slow.npos);
  EXPECT_EQ(calibrationDoubts({{"n1", "cpu", even(50, 1e-3)}, {"n2", "other", even(50, 1.3e-3)}}), "");
  EXPECT_EQ(calibrationDoubts({{"n1", "cpu", even(50, 1e-3)}, {"n2", "cpu", even(4, 1.3e-3)}}), "") << "too few";
}

class Calibrations : public StoredRuns {};

TEST_F(Calibrations, StandBesideTheTimesAndInTheHead) {
  run();
  Study timed = study();
  timed.timing = {true, 1e-5, 1, 10, 20};
  const RunKeys keys = runKeys(timed, {});
  {
    Store writer(folder(), "small", Use::kWrite, {}, told_);
    timeStudy(timed, keys, writer, {}, told_);
    writer.exportTables(keys);
  }
  const Table measured = readTable(folder() / "calibrations.csv");
  ASSERT_GE(measured.rows.size(), 1u);
  EXPECT_EQ(textAt(measured, measured.rows[0], "environment"), thisEnvironment().front());
  const double seconds = numberAt(measured, measured.rows[0], "calibration_s");
  EXPECT_GT(seconds, 1e-5);
  EXPECT_LT(seconds, 1);
  {
    Store writer(folder(), "small", Use::kWrite, {}, told_);
    for (int i = 1; i <= 10; ++i) writer.addCalibration(i * seconds);
    writer.exportTables(keys);
  }
  EXPECT_TRUE(containsAll(timesDrift(folder() / "runs.csv"), {"calibrations", hostName()}));
  std::ostringstream out;
  tellDrift("small", folder() / "runs.csv", out);
  EXPECT_TRUE(containsAll(out.str(), {"small", "doubtful", hostName()}));
  run("calm");
  EXPECT_EQ(timesDrift(folder("calm") / "runs.csv"), "");
  // They are merged like rows.
  Store merged(folder("merged"), "small", Use::kWrite, {}, told_);
  merged.takeOver(reader());
  merged.exportTables(keys);
  EXPECT_EQ(readTable(folder("merged") / "calibrations.csv").rows.size(), measured.rows.size() + 10);
  EXPECT_NE(timesDrift(folder("merged") / "runs.csv"), "");
}

}  // namespace
}  // namespace irk::store
