#include "experiments/analyses/parallel.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <sstream>
#include <thread>

#include "experiments/base/interrupt.h"
#include "experiments/runs/run_table.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

TEST(Parallel, MeasuresWithPowersOfTwoAndAllProcessors) {
  EXPECT_EQ(processorCounts(1), (std::vector<int>{1}));
  EXPECT_EQ(processorCounts(2), (std::vector<int>{1, 2}));
  EXPECT_EQ(processorCounts(6), (std::vector<int>{1, 2, 4, 6}));
  EXPECT_EQ(processorCounts(16), (std::vector<int>{1, 2, 4, 8, 16}));
}

// Amdahl's law, forward: of 1 s, f is done alone and 1 - f is divided.
TEST(Parallel, TheSerialShareIsThatOfAmdahlsLaw) {
  for (const double f : {0.0, 0.1, 0.5, 1.0}) {
    for (const int p : {2, 8}) EXPECT_NEAR(serialShare(1 / (f + (1 - f) / p), p), f, 1e-14) << f << " " << p;
  }
  EXPECT_TRUE(std::isnan(serialShare(1, 1)));
}

TEST(Parallel, ARowForEachWayAndNumberOfProcessors) {
  const auto [study, runs] = runsOf(R"(
parallel = true
[[block]]
scene = "beam_chain"
settings = "m=120"
methods = "radau_iia_3"
steps = [1e-4]
t_end = 1e-3
)");
  std::ostringstream quiet;
  const Table table = parallelTable(study, runs, {1, 2}, quiet);
  ASSERT_EQ(table.rows.size(), 4u);
  const char* const ways[] = {"threads", "threads", "runs", "runs"};
  const auto at = [&](std::size_t row, const char* column) { return numberAt(table, table.rows[row], column); };
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(textAt(table, table.rows[i], "way"), ways[i]);
    EXPECT_EQ(textAt(table, table.rows[i], "n"), "120");
    const double p = i % 2 == 0 ? 1 : 2, work = i == 3 ? 2 : 1;
    EXPECT_EQ(at(i, "processors"), p);
    EXPECT_GT(at(i, "wall_s"), 0);
    EXPECT_NEAR(at(i, "speedup"), work * at(i - i % 2, "wall_s") / at(i, "wall_s"), 1e-9 * at(i, "speedup"));
    EXPECT_NEAR(at(i, "efficiency"), at(i, "speedup") / p, 1e-9 * at(i, "speedup"));
  }
}

// Ctrl-C in the first of two runs, which takes seconds: no row has numbers of a measurement that was cut short.
TEST(Parallel, AnInterruptLeavesNoRowThatIsHalfMeasured) {
  const auto [study, runs] = runsOf(R"(
[[block]]
scene = "beam_chain"
settings = ["m=120", "m=121"]
storage = "dense"
methods = "radau_iia_9"
steps = [1e-3]
t_end = 0.1
)");
  std::ostringstream told;
  Table table;
  {
    const InterruptScope interrupts;
    std::thread user([] {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      std::raise(SIGINT);
    });
    table = parallelTable(study, runs, {1, 2}, told);
    user.join();
    EXPECT_TRUE(interruptFlag());
  }
  const InterruptScope uninterrupted;  // the flag is false again
  EXPECT_TRUE(table.rows.empty()) << textAt(table, table.rows.front(), "wall_s");
  EXPECT_EQ(told.str(), "") << "no run is measured";
}

// The row of a study tells what was used.
TEST(Parallel, ARowWithTooManyThreadsSaysThatOneWasTaken) {
  const auto [study, runs] = runsOf(R"(
[[block]]
scene = "beam_chain"
settings = ["m=50", "m=120"]
threads = 2
methods = "radau_iia_3"
steps = [1e-4]
t_end = 1e-3
)");
  ASSERT_EQ(runs.rows.size(), 2u);
  EXPECT_EQ(textAt(runs, runs.rows[0], "detail"),
            "threads = 2 does not pay with 50 unknowns: below 100 one thread is taken");
  EXPECT_EQ(textAt(runs, runs.rows[1], "detail"), "");
}

}  // namespace
}  // namespace irk
