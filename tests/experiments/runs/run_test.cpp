#include "experiments/runs/run.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runs/fields.h"
#include "experiments/runs/run_table.h"
#include "experiments/solution/trajectory.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

TEST(Run, IsAPureFunctionOfItsSpec) {
  const RunSpec run = parseSpec("scene=pendulum;t_end=1;method=radau_iia_3;rtol=1e-8;atol=1e-8");
  const RunRecord a = execute(run), b = execute(run);
  ASSERT_TRUE(a.succeeded()) << a.detail;
  EXPECT_EQ(a.u, b.u);
  EXPECT_EQ(a.errors.all, b.errors.all);
  EXPECT_EQ(a.counters.residuals, b.counters.residuals);
  // Executes the same prepared run twice: the first execution must not affect the second.
  const auto prepared = prepare(run);
  (void)prepared->execute({});
  EXPECT_EQ(prepared->execute({}).u, a.u);
}

TEST(Run, ErrorsAgainstAClosedForm) {
  const RunRecord run = execute(parseSpec("scene=riccati_tracking;method=gauss_4;h=0.25;control=fixed;estimate=none"));
  ASSERT_TRUE(run.succeeded()) << run.detail;
  EXPECT_GT(run.errors.all, 0);
  EXPECT_LT(run.errors.all, 1e-6);
  EXPECT_TRUE(std::isnan(run.errors.u) && std::isnan(run.errors.z));
  EXPECT_EQ(run.errors.x, run.errors.all);
}

// y = 1.5 + sin 2 at the end, |error| = errors.all y.
TEST(Run, DigitsReferToTheTolerancesOfTheRun) {
  const double y = 1.5 + std::sin(2.0);
  const auto run = [&](const char* more) {
    return execute(parseSpec("scene=riccati_tracking;method=radau_iia_3;" + std::string(more))).errors;
  };
  const auto digits = [&](const RunErrors& e, double atol_over_rtol) {
    return -std::log10(e.all * y / (atol_over_rtol + y));
  };
  const RunErrors equal = run("rtol=1e-6;atol=1e-6");
  EXPECT_NEAR(equal.mescd(), digits(equal, 1), 1e-6);
  EXPECT_NEAR(equal.scd(), digits(equal, 0), 1e-6);
  const RunErrors loose = run("rtol=1e-6;atol=1e-5");
  EXPECT_NEAR(loose.mescd(), digits(loose, 10), 1e-6);
  const RunErrors of_component = run("rtol=1e-6;atol=1e-5;atol_of=y=1e-3");
  EXPECT_NEAR(of_component.mescd(), digits(of_component, 1000), 1e-6);
  const RunErrors peer = execute(parseSpec("scene=riccati_tracking;method=cvode_bdf;rtol=1e-6;atol=1e-5")).errors;
  EXPECT_NEAR(peer.mescd(), digits(peer, 10), 1e-6);
  const RunErrors constant = run("h=0.25;control=fixed;estimate=none");
  EXPECT_TRUE(std::isnan(constant.mescd())) << "no tolerances";
  EXPECT_NEAR(constant.scd(), digits(constant, 0), 1e-6);
}

TEST(Run, ErrorsAgainstReferences) {
  const RunRecord run = execute(parseSpec("scene=slider_crank;t_end=1;method=radau_iia_5;rtol=1e-10;atol=1e-10"));
  ASSERT_TRUE(run.succeeded()) << run.detail;
  EXPECT_NEAR(run.u[0], 14.127892217751, 1e-7);
  EXPECT_LT(run.errors.u, 1e-7);
  EXPECT_TRUE(std::isnan(execute(parseSpec("scene=slider_crank;t_end=0.95;rtol=1e-3")).errors.all));
}

TEST(Run, FailuresAreRecords) {
  const RunRecord few = execute(parseSpec("scene=kepler;max_steps=2;rtol=1e-10;atol=1e-10"));
  EXPECT_EQ(few.outcome, "max_steps");
  EXPECT_FALSE(few.detail.empty());
  EXPECT_TRUE(std::isnan(few.errors.all));
  const RunRecord late = execute(parseSpec("scene=kepler;time_limit=1e-9;rtol=1e-10;atol=1e-10"));
  EXPECT_EQ(late.outcome, "timeout");
}

TEST(Run, StopsWhenAsked) {
  const std::atomic<bool> stop = true;
  const RunRecord run = execute(parseSpec("scene=kepler"), {&stop, {}, {}});
  EXPECT_EQ(run.outcome, "interrupted");
}

TEST(Run, FiftyDigits) {
  const RunRecord run =
      execute(parseSpec("scene=riccati_tracking;scalar=mp50;method=gauss_8;h=0.125;control=fixed;estimate=none"));
  ASSERT_TRUE(run.succeeded()) << run.detail;
  EXPECT_LT(run.errors.all, 1e-17);  // below what double can show
  ASSERT_EQ(run.digits.size(), 1u);
  EXPECT_GE(run.digits[0].size(), 40u);
}

TEST(Run, TrajectoriesOfTableausInTwoFoldersStayApart) {
  RunSpec first = parseSpec("scene=slider_crank"), second = first;
  first.method = "a/mine.txt";
  second.method = "b/mine.txt";
  EXPECT_EQ(trajectoryPath("r", first), std::filesystem::path("r") / "slider_crank.a_mine.txt.csv");
  EXPECT_NE(trajectoryPath("r", first), trajectoryPath("r", second));
}

TEST(Run, TrajectoryHoldsStartAndEnd) {
  const TemporaryFolder folder;
  const RunSpec run = parseSpec("scene=slider_crank;t_end=0.3");
  const auto file = trajectoryPath(folder.path(), run);
  EXPECT_EQ(file.filename(), "slider_crank.radau_iia_5.csv");
  const RunRecord record = executeWithTrajectory(run, {}, file);
  const Table table = readTable(file);
  ASSERT_EQ(table.rows.size(), static_cast<std::size_t>(record.counters.steps_accepted) + 1);
  EXPECT_EQ(table.rows.front()[0], "0");
  EXPECT_EQ(std::stod(table.rows.back()[table.column("theta")]), record.u[0]);
  EXPECT_TRUE(table.hasColumn("x3"));
  double time = 0;
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    time += numberAt(table, table.rows[i], "h");
    EXPECT_LE(numberAt(table, table.rows[i], "error"), 1) << "accepted";
    EXPECT_GT(numberAt(table, table.rows[i], "newton_iterations"), 0);
  }
  EXPECT_NEAR(time, 0.3, 1e-12);
}

}  // namespace
}  // namespace irk
