#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/number_text.h"
#include "experiments/ensembles/grid.h"
#include "experiments/tables/table.h"
#include "irk/misuse.h"
#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

TEST(Grid, HasAllCombinationsAndTheLastChangesFastest) {
  const Grid grid({gridAxis("--set", "a=0..1:3"), gridAxis("--set", "b=x,y")}, {gridAxis("--start", "c=1..100:3:log")});
  ASSERT_EQ(grid.size(), 18U);
  using Values = std::vector<std::string_view>;
  EXPECT_EQ(grid.at(0), (Values{"0", "x", "1"}));
  EXPECT_EQ(grid.at(1)[2].substr(0, 2), "10");
  EXPECT_EQ(grid.at(2), (Values{"0", "x", "100"}));
  EXPECT_EQ(grid.at(3), (Values{"0", "y", "1"}));
  EXPECT_EQ(grid.at(17), (Values{"1", "y", "100"}));
  EXPECT_EQ(grid.at(8)[0], "0.5");
}

TEST(Grid, RefusesTextsThatAreNoGrid) {
  for (const auto* text : {"a", "=1", "a=1,,2", "a=1..2", "a=1..2:1", "a=1..2:x", "a=x..2:3", "a=-1..2:3:log"}) {
    EXPECT_THROW(gridAxis("--set", text), Misuse) << text;
  }
  EXPECT_THROW(Grid({gridAxis("--set", "a=1"), gridAxis("--set", "a=2")}, {}), Misuse);
  EXPECT_THROW(Grid({gridAxis("--set", "a=0..1:10000"), gridAxis("--set", "b=0..1:10000")}, {}), Misuse);
}

std::vector<nlohmann::json> objectsOf(const std::string& lines) {
  std::vector<nlohmann::json> all;
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);) all.push_back(nlohmann::json::parse(line));
  return all;
}

// All scenes with lanes: rows of lanes and of single runs agree, and those with an exact solution or a reference are
// right.
TEST(EnsembleVerb, RowsAreThoseOfSingleRuns) {
  const std::vector<std::vector<std::string>> grids = {{"van_der_pol", "--set", "eps=1e-4..1e-1:11:log"},
                                                       {"kaps", "--set", "eps=1e-6..1:11:log"},
                                                       {"robertson", "--start", "y1=0.5..1:11"},
                                                       {"hires", "--start", "y8=0.003..0.009:11"},
                                                       {"orego", "--start", "y2=1..3:11", "--t-end", "30"},
                                                       {"dahlquist", "--set", "lambda_re=-100..-1:11"},
                                                       {"prothero_robinson", "--set", "lambda=-1000..-1:11"},
                                                       {"kepler", "--set", "e=0.1..0.6:11", "--t-end", "6"},
                                                       {"pendulum", "--set", "l=0.5..2:11", "--t-end", "2"},
                                                       {"caraxis", "--formulation", "index2,"},
                                                       {"mechanical_dae", "--formulation", "index1"},
                                                       {"chemakzo", "--start", "y1=0.4,0.444"},
                                                       {"e5", "--t-end", "1e5"}};
  for (auto arguments : grids) {
    SCOPED_TRACE(arguments.front());
    if (arguments.back() == "index2,") arguments.back() = "index2";
    arguments.insert(arguments.begin(), "ensemble");
    arguments.insert(arguments.end(), {"--method", "radau_iia_3", "--tol", "1e-6", "--json", "--jobs", "2"});
    const auto lanes = program(arguments);
    arguments.push_back("--single");
    const auto single = program(arguments);
    ASSERT_EQ(lanes.status, 0) << lanes.err << lanes.out;
    ASSERT_EQ(single.status, 0) << single.err;
    const auto a = objectsOf(lanes.out), b = objectsOf(single.out);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (const auto& [key, value] : b[i].items()) {
        if (!value.is_number_float() || !a[i][key].is_number()) continue;
        EXPECT_NEAR(a[i][key].get<double>(), value.get<double>(), 1e-6 * (1e-3 + std::abs(value.get<double>()))) << key;
      }
      // Rounding changes a decision in some runs, see the tests of LaneIntegrator.
      const auto steps = b[i]["steps_accepted"].get<double>();
      EXPECT_NEAR(a[i]["steps_accepted"].get<double>(), steps, 0.01 * steps) << i;
    }
  }
}

TEST(EnsembleVerb, DoesNotDependOnThreads) {
  const std::vector<std::string> arguments = {"ensemble", "kepler", "--set", "e=0.1..0.6:40", "--t-end", "3", "--jobs"};
  const auto with = [&](const char* jobs) {
    auto all = arguments;
    all.emplace_back(jobs);
    return program(all).out;
  };
  EXPECT_EQ(with("1"), with("3"));
}

TEST(EnsembleVerb, IsRightWhereTheSolutionIsKnown) {
  const auto run = program(
      {"ensemble", "kaps", "--set", "eps=1e-6..1:20:log", "--method", "radau_iia_3", "--tol", "1e-8", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto rows = objectsOf(run.out);
  ASSERT_EQ(rows.size(), 20U);
  for (const auto& row : rows) {
    EXPECT_NEAR(row["y1"].get<double>(), std::exp(-2), 1e-6);
    EXPECT_NEAR(row["y2"].get<double>(), std::exp(-1), 1e-6);
  }
}

TEST(EnsembleVerb, WritesATable) {
  const auto file = std::filesystem::temp_directory_path() / "irk_ensemble_test.csv";
  const auto run = program({"ensemble", "kepler", "--set", "e=0.2,0.4", "--start", "q2=0,0.01,0.02", "--t-end", "1",
                            "--max-steps", "30", "--out", file.string()});
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("6 of 6 runs"), std::string::npos) << run.err;
  const Table table = readTable(file);
  std::filesystem::remove(file);
  ASSERT_EQ(table.rows.size(), 6U);
  EXPECT_EQ(table.rows[4][table.column("e")], "0.4");
  EXPECT_EQ(table.rows[4][table.column("q2_start")], "0.01");
}

// A table is renamed to its name when it is complete: that must not remove a device such as /dev/null.
TEST(EnsembleVerb, LeavesDevicesAlone) {
  const TemporaryFolder folder;
  const auto device = folder.path() / "device";
  std::filesystem::create_symlink("/dev/null", device);
  const auto run = program({"ensemble", "kepler", "--set", "e=0.2,0.4", "--t-end", "1", "--out", device.string()});
  EXPECT_EQ(run.status, 2);
  EXPECT_TRUE(containsAll(run.err, {device.string(), "a device", "regular file"})) << run.err;
  EXPECT_TRUE(std::filesystem::is_symlink(device));
}

TEST(EnsembleVerb, FailedMembersAreRows) {
  const auto run = program(
      {"ensemble", "kepler", "--set", "e=0.1,0.9", "--tol", "1e-10", "--max-steps", "60", "--t-end", "6", "--json"});
  EXPECT_EQ(run.status, 1);
  const auto rows = objectsOf(run.out);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1]["outcome"], "max_steps");
  EXPECT_NE(rows[1]["detail"], "");
}

TEST(EnsembleVerb, RefusesWhatLanesCannotIntegrate) {
  const struct {
    std::vector<std::string> arguments;
    std::string part;
  } cases[] = {
      {{"bouncing_mass"}, "bouncing_mass has no lanes"},
      {{"kepler", "--set", "e=0.5..1.5:3"}, "0.99"},
      {{"kepler", "--set", "a=1"}, "'a'"},
      {{"kepler", "--start", "q3=1"}, "'q3'"},
      {{"kepler", "--start", "q1=x"}, "'x'"},
      {{"kepler", "--method", "gauss_3"}, "gauss_3"},
      {{"kepler", "--method", "cvode_bdf"}, "cvode_bdf"},
      {{"kepler", "--newton", "broyden"}, "'broyden'"},
      {{"kepler", "--configuration", "default"}, "lanes have"},
      {{"kepler", "--scalar", "mp50"}, "mp50"},
      {{"kepler", "--step", "0.1"}, "lanes have"},
      {{"pendulum", "--formulation", "ggl"}, "ggl"},
  };
  for (const auto& c : cases) {
    std::vector<std::string> arguments = {"ensemble"};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const auto run = program(arguments);
    EXPECT_EQ(run.status, 2) << c.part;
    EXPECT_EQ(run.out, "") << c.part;
    EXPECT_NE(run.err.find(c.part), std::string::npos) << run.err;
  }
  EXPECT_EQ(program({"ensemble", "bouncing_mass", "--set", "m=1,2", "--single"}).status, 0);
}

}  // namespace
}  // namespace irk
