// `irk solve --out --points`: the solution over time as a file.
#include <gtest/gtest.h>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/tables/table.h"
#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

using Json = nlohmann::json;

class SolveOut : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.path() / name; }
  Table table(std::vector<std::string> arguments, int status = 0) const {
    arguments.insert(arguments.begin(), "solve");
    arguments.insert(arguments.end(), {"--out", file("run.csv")});
    const Ended run = program(arguments);
    EXPECT_EQ(run.status, status) << run.err;
    return readTable(file("run.csv"));
  }
  TemporaryFolder folder_;
};

double cell(const Table& table, std::size_t row, std::string_view column) {
  return std::stod(table.rows[row][table.column(column)]);
}

TEST_F(SolveOut, WithoutPointsTheRowsAreTheSteps) {
  const Table rows = table({"kepler", "--tol", "1e-8", "--t-end", "5"});
  const Json run = solvedJson({"kepler", "--tol", "1e-8", "--t-end", "5"});
  EXPECT_EQ(rows.rows.size(), run["steps"]["accepted"].get<std::size_t>() + 1);
  double time = 0;
  for (std::size_t i = 1; i < rows.rows.size(); ++i) time += cell(rows, i, "h");
  EXPECT_NEAR(time, 5, 1e-12);
}

// Each point against a run of its own that ends there; with another precision, too.
TEST_F(SolveOut, PointsAreEquallySpacedAndOnTheSolution) {
  const std::vector<std::string> run{"slider_crank", "--tol", "1e-9", "--method", "radau_iia_7", "--t-end", "0.8"};
  auto arguments = run;
  arguments.insert(arguments.end(), {"--points", "9"});
  const Table rows = table(arguments);
  ASSERT_EQ(rows.rows.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(cell(rows, i, "t"), 0.1 * static_cast<double>(i), 1e-15);
  EXPECT_EQ(rows.rows.back()[0], "0.8");
  for (const std::size_t i : {1u, 4u, 7u, 8u}) {
    auto part = run;
    part.back() = rows.rows[i][0];
    const Json end = solvedJson(part);
    EXPECT_NEAR(cell(rows, i, "theta"), end["u"][0].get<double>(), 1e-7) << i;
    EXPECT_NEAR(cell(rows, i, "phi'"), end["v"][1].get<double>(), 1e-6) << i;
  }
}

// Kepler's orbit begins at an apsis, which mirrors the motion: q1(-t) = q1(t), q2(-t) = -q2(t).
TEST_F(SolveOut, BackwardPointsAreTheMirrorOfForwardOnes) {
  const Table forward = table({"kepler", "--tol", "1e-9", "--t-end", "2", "--points", "9"});
  const Table backward = table({"kepler", "--tol", "1e-9", "--t-end", "-2", "--points", "9", "--bars"});
  ASSERT_EQ(backward.rows.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(cell(backward, i, "t"), -0.25 * static_cast<double>(i), 1e-15);
    EXPECT_NEAR(cell(backward, i, "q1"), cell(forward, i, "q1"), 1e-7) << i;
    EXPECT_NEAR(cell(backward, i, "q2"), -cell(forward, i, "q2"), 1e-7) << i;
    EXPECT_NEAR(cell(backward, i, "q2'"), cell(forward, i, "q2'"), 1e-7) << i;
  }
  const Table steps = table({"kepler", "--tol", "1e-9", "--t-end", "-2"});
  double time = 0;
  for (std::size_t i = 1; i < steps.rows.size(); ++i) time += cell(steps, i, "h");
  EXPECT_NEAR(time, -2, 1e-12);
}

TEST_F(SolveOut, AlsoInFiftyDigits) {
  const Table rows = table({"riccati_tracking", "--scalar", "mp50", "--step", "0.25", "--method", "radau_iia_5",
                            "--t-end", "1", "--points", "11"});
  ASSERT_EQ(rows.rows.size(), 11u);
  EXPECT_EQ(rows.rows.back()[0], "1");
  EXPECT_TRUE(std::isfinite(cell(rows, 5, rows.columns.back())));
}

// Kepler's motion is known: x = cos E - e, with Kepler's equation t = E - e sin E. Bars say how far each row is off.
TEST_F(SolveOut, BarsAreTheErrorsOfTheRows) {
  for (const char* tolerance : {"1e-4", "1e-7"}) {
    const Table rows =
        table({"kepler", "--set", "e=0.3", "--tol", tolerance, "--t-end", "6", "--points", "31", "--bars"});
    ASSERT_EQ(rows.rows.size(), 31u);
    const std::string x = rows.columns[5];
    const double least = 2e-3 * std::stod(tolerance);
    double largest = 0;
    for (std::size_t i = 1; i < rows.rows.size(); ++i) {
      const double t = cell(rows, i, "t");
      double E = t;
      for (int k = 0; k < 100; ++k) E -= (E - 0.3 * std::sin(E) - t) / (1 - 0.3 * std::cos(E));
      const double error = std::abs(cell(rows, i, x) - (std::cos(E) - 0.3)), bar = cell(rows, i, "bar " + x);
      EXPECT_LE(error, 3 * bar + least) << tolerance << " " << t;
      EXPECT_LE(bar, 3 * error + least) << tolerance << " " << t;
      largest = std::max(largest, error);
    }
    EXPECT_GT(largest, 10 * least) << "errors are too small to tell a bar from none";
  }
}

// A switch has a row before and one after it; between them the state may jump.
TEST_F(SolveOut, SwitchesHaveARowBeforeAndAfter) {
  const Table rows = table({"stick_slip", "--tol", "1e-8", "--points", "101"});
  const Json run = solvedJson({"stick_slip", "--tol", "1e-8"});
  ASSERT_EQ(run["switches"].size(), 6u);
  EXPECT_EQ(rows.rows.size(), 101u + 2 * 6);
  const std::size_t switches = rows.column("switches");
  std::size_t found = 0;
  for (std::size_t i = 1; i < rows.rows.size(); ++i) {
    EXPECT_GE(cell(rows, i, "t"), cell(rows, i - 1, "t"));
    if (rows.rows[i][switches].empty()) continue;
    EXPECT_EQ(rows.rows[i][0], rows.rows[i - 1][0]);
    EXPECT_EQ(rows.rows[i][switches], run["switches"][found]["name"].get<std::string>());
    EXPECT_NEAR(cell(rows, i, "t"), run["switches"][found]["t"].get<double>(), 1e-14);
    ++found;
  }
  EXPECT_EQ(found, 6u);
}

TEST_F(SolveOut, HasUnitsAndTheRunInItsHead) {
  const Table rows = table({"slider_crank", "--t-end", "0.1"});
  const auto entry = [&rows](const std::string& key) {
    for (const auto& [name, value] : rows.head) {
      if (name == key) return value;
    }
    return std::string("none");
  };
  EXPECT_TRUE(containsAll(entry("units"), {"s,s,,,,rad,rad,rad/s,rad/s"})) << entry("units");
  EXPECT_TRUE(containsAll(entry("run"), {"scene=slider_crank", "t_end=0.1"}));
}

TEST_F(SolveOut, AFailedRunLeavesTheRowsUpToItsEnd) {
  const std::vector<std::string> run{"solve", "slider_crank", "--method", "gauss_3", "--tol", "1e-4"};
  auto arguments = run;
  arguments.insert(arguments.end(), {"--out", file("run.csv"), "--points", "20", "--json"});
  const Ended ended = program(arguments);
  EXPECT_EQ(ended.status, 1);
  EXPECT_TRUE(containsAll(ended.err, {"run.csv", "holds the solution up to t = ", "step_too_small"})) << ended.err;
  const Table rows = readTable(file("run.csv"));
  const double reached = Json::parse(ended.out)["t"].get<double>();
  EXPECT_DOUBLE_EQ(cell(rows, rows.rows.size() - 1, "t"), reached);
  EXPECT_EQ(rows.rows.size(), static_cast<std::size_t>(reached * 19 / 2) + 2);  // t_end is 2
}

TEST_F(SolveOut, JsonLinesHaveAHeadAndTheSameNumbers) {
  const std::vector<std::string> run{"solve", "bouncing_mass", "--points", "7"};
  for (const char* name : {"run.csv", "run.jsonl"}) {
    auto arguments = run;
    arguments.insert(arguments.end(), {"--out", file(name)});
    ASSERT_EQ(program(arguments).status, 0);
  }
  const Table rows = readTable(file("run.csv"));
  std::ifstream lines(file("run.jsonl"));
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  const Json head = Json::parse(line);
  EXPECT_EQ(head["schema"], "irk-solution-1");
  EXPECT_EQ(head["units"]["gap"], "m");
  std::size_t i = 0;
  for (; std::getline(lines, line); ++i) {
    ASSERT_LT(i, rows.rows.size());
    const Json row = Json::parse(line);
    EXPECT_EQ(row["t"].get<double>(), cell(rows, i, "t"));
    EXPECT_EQ(row["values"]["gap"].get<double>(), cell(rows, i, "gap"));
    EXPECT_EQ(row["switches"].get<std::string>(), rows.rows[i][rows.column("switches")]);
  }
  EXPECT_EQ(i, rows.rows.size());
}

TEST_F(SolveOut, OtherLibrariesGiveTheirStepsOnly) {
  const Table rows = table({"kepler", "--method", "cvode_bdf", "--t-end", "1"});
  EXPECT_GT(rows.rows.size(), 10u);
}

TEST_F(SolveOut, RefusesIllegalOptions) {
  std::ofstream(file("kept.csv")) << "mine\n";
  for (const char* name : {"device.csv", "device.svg"}) std::filesystem::create_symlink("/dev/null", file(name));
  expectOneLine({{2, {"solve", "kepler", "--bars"}, "--bars", {"--out"}},
                 {2, {"solve", "kepler", "--bars", "--out", "@/run.csv"}, "--bars", {"--points"}},
                 {2, {"solve", "kepler", "--points", "10"}, "--points", {"--out"}},
                 {2,
                  {"solve", "kepler", "--method", "cvode_bdf", "--out", "@/run.csv", "--points", "10"},
                  "--points",
                  {"cvode_bdf", "steps only"}},
                 {2, {"solve", "kepler", "--out", "@/run.txt"}, "run.txt", {".csv", ".jsonl"}},
                 {2, {"solve", "kepler", "--out", "@/none/run.csv"}, "no folder", {"none"}},
                 {2, {"solve", "kepler", "--out", "@/device.csv"}, "device.csv", {"a device", "regular file"}},
                 {2, {"solve", "kepler", "--plot", "@/device"}, "device.svg", {"a device", "regular file"}},
                 {2, {"solve", "kepler", "--out", "@/run.csv", "--points", "1"}, "points", {"1", "2"}},
                 {2, {"solve", "kepler", "--out", "@/run.csv", "--points", "2000000"}, "points", {"2000000"}},
                 {2, {"solve", "kepler", "--out", "@/run.csv", "--points", "many"}, "points", {"many"}},
                 {2, {"solve", "kepler", "--out", "@/run.csv", "--tol", "1e-4,1e-5"}, "--out", {"tol"}},
                 {2, {"solve", "kepler", "--plot", "@/run", "--tol", "1e-4,1e-5"}, "--plot", {"tol"}},
                 {2, {"solve", "kepler", "--out", "@/kept.csv", "--formulation", "ggll"}, "ggll"},
                 {2, {"solve", "kepler", "--out", "@/kept.csv", "--estimate", "none"}, "none"}},
                folder_.path());
  std::ifstream kept(file("kept.csv"));
  std::string text;
  std::getline(kept, text);
  EXPECT_EQ(text, "mine");
}

}  // namespace
}  // namespace irk
