#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/number_text.h"
#include "experiments/ensembles/ensemble_run.h"
#include "experiments/runs/fields.h"
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

// Kinds of methods, scalars, scenes and formulations. Without options the strategies are those of `embedded`.
TEST(EnsembleVerb, RowsAreThoseOfSolve) {
  const struct {
    std::vector<std::string> run;
    std::string name, grid, last;
  } cases[] = {
      {{"van_der_pol"}, "eps", "1e-4..1e-2:3:log", "0.01"},
      {{"kepler", "--method", "gauss_3", "--configuration", "default", "--t-end", "3"}, "e", "0.1,0.3", "0.3"},
      {{"kepler", "--step", "0.1", "--configuration", "embedded"}, "e", "0.1,0.3", "0.3"},
      {{"kepler", "--method", "cvode_bdf", "--t-end", "3"}, "e", "0.1,0.3", "0.3"},
      {{"kepler", "--scalar", "mp30", "--t-end", "1", "--configuration", "default"}, "e", "0.1,0.3", "0.3"},
      {{"hires", "--configuration", "variable", "--t-end", "10"}, "", "", ""},
      {{"bouncing_mass"}, "m", "1,2", "2"},
      {{"pendulum", "--formulation", "ggl", "--configuration", "embedded"}, "l", "0.5..2:3", "2"},
      {{"pendulum", "--formulation", "index2_projected", "--configuration", "embedded"}, "l", "0.5..2:3", "2"},
      {{"pendulum", "--formulation", "first_order", "--configuration", "embedded"}, "l", "0.5..2:3", "2"},
  };
  for (const auto& c : cases) {
    std::vector<std::string> many = c.run, one = c.run;
    many.insert(many.begin(), "ensemble"), one.insert(one.begin(), "solve");
    if (!c.name.empty()) {
      many.insert(many.end(), {"--set", c.name + "=" + c.grid});
      one.insert(one.end(), {"--set", c.name + "=" + c.last});
    }
    many.insert(many.end(), {"--json", "--jobs", "2"});
    one.insert(one.end(), {"--json", "--error-bar", "none"});
    if (c.run.size() == 1) one.insert(one.end(), {"--configuration", "embedded"});
    const auto rows = program(many), single = program(one);
    SCOPED_TRACE(c.run.front() + " " + (c.run.size() > 2 ? c.run[2] : ""));
    ASSERT_EQ(rows.status, 0) << rows.err << rows.out;
    ASSERT_EQ(single.status, 0) << single.err;
    const auto row = objectsOf(rows.out).back(), expected = nlohmann::json::parse(single.out);
    EXPECT_EQ(row["outcome"], expected["outcome"]);
    EXPECT_EQ(row["steps_accepted"], expected["steps"]["accepted"]);
    EXPECT_EQ(row["newton_iterations"], expected["counters"]["newton_iterations"]);
    for (const char* group : {"u", "v", "x", "z"}) {
      for (std::size_t i = 0; i < expected["names"][group].size(); ++i) {
        const std::string name = expected["names"][group][i];
        const auto& value = expected[group][i];
        EXPECT_EQ(row[name].get<double>(),
                  value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>())
            << name;
      }
    }
  }
}

// All that a record says of the result, with all digits.
std::string textOf(const RunRecord& record) {
  std::string text = record.outcome + " " + record.detail + " " + numberText(record.t);
  for (const Vec<double>* part : {&record.u, &record.v, &record.x, &record.z}) {
    for (const double y : *part) text += " " + numberText(y);
  }
  record.counters.forEach([&](const char*, std::int64_t count) { text += " " + std::to_string(count); });
  return text;
}

std::vector<std::string> textsOf(const Ensemble& ensemble, int jobs) {
  std::vector<std::string> texts(ensemble.grid().size());
  runEnsemble(ensemble, jobs, false, [&](std::size_t i, const RunRecord& record) { texts[i] = textOf(record); });
  return texts;
}

// What a thread has prepared and used for other starts, also for those that cannot be solved, gives the bits of a new
// run.
TEST(Ensemble, StartsOfEveryScene) {
  for (const SceneEntry& entry : sceneCatalogue()) {
    if (entry.registered) continue;
    SCOPED_TRACE(entry.id);
    RunSpec spec;
    spec.scene = entry.id;
    spec.method = "radau_iia_3";
    findField("configuration").set(spec, "embedded");
    spec.options.step.max_steps = 15;
    const auto scene = makeScene<double>(entry.id);
    const bool mechanism = scene.start.u.size() > 0;
    const std::string name = scene.names[static_cast<std::size_t>(mechanism ? scene.start.u.size() : 0)];
    const double own = mechanism ? scene.start.v[0] : scene.start.x[0];
    GridAxis axis{name, {}};
    for (const double change : {0.0, 1e-3, -1e-2, 1e300, 0.0}) axis.values.push_back(numberText(own + change));
    const Ensemble ensemble(spec, Grid({}, {axis}));
    const auto rows = textsOf(ensemble, 1);
    EXPECT_EQ(rows, textsOf(ensemble, 3));
    EXPECT_NE(rows[0], rows[1]);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto single = prepare(ensemble.spec(i));
      single->startFrom(ensemble.start(i));
      EXPECT_EQ(rows[i], textOf(single->execute({}))) << i;
    }
  }
}

// The scene's exact solution is that of its own start.
TEST(Run, FromAnotherStartHasNoError) {
  RunSpec spec;
  spec.scene = "dahlquist";
  spec.options.tolerances = {1e-12, 1e-12};
  const auto own = execute(spec);
  EXPECT_LT(own.errors.all, 1e-9);
  const std::string name = makeScene<double>("dahlquist").names[0];
  for (const char* method : {"radau_iia_5", "cvode_bdf"}) {
    spec.method = method;
    const auto run = prepare(spec);
    run->startFrom({{name, "2"}});
    const auto twice = run->execute({});
    EXPECT_NEAR((twice.x - 2 * own.x).norm(), 0, 1e-9) << method;
    EXPECT_TRUE(std::isnan(twice.errors.all)) << method;
    EXPECT_THROW(run->startFrom({{"y9", "2"}}), Misuse);
    EXPECT_THROW(run->startFrom({{name, "two"}}), Misuse);
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

TEST(EnsembleVerb, MeasuresErrorBarsOnRequest) {
  const std::vector<std::string> grid = {"ensemble", "kaps", "--set", "eps=1e-3,1", "--json"};
  const auto plain = program(grid);
  auto arguments = grid;
  arguments.insert(arguments.end(), {"--error-bar", "measured"});
  const auto rows = objectsOf(program(arguments).out);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_FALSE(objectsOf(plain.out).front().contains("error_bar_tolerances"));
  for (const auto& row : rows) {
    EXPECT_GT(row["error_bar_tolerances"].get<double>(), 0);
    EXPECT_LT(row["error_bar_tolerances"].get<double>(), 1000);
  }
}

// Each value is in its range, but with a short rod the crank cannot turn.
TEST(EnsembleVerb, RefusedMembersAreRows) {
  const auto run = program({"ensemble", "spatial_slider_crank", "--set", "L=0.3,0.01,0.4", "--t-end", "0.1", "--json"});
  EXPECT_EQ(run.status, 1) << run.err;
  const auto rows = objectsOf(run.out);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[1]["outcome"], "refused");
  EXPECT_NE(rows[1]["detail"].get<std::string>().find("the crank cannot turn"), std::string::npos);
  EXPECT_EQ(rows[1].size(), rows[0].size());
  EXPECT_EQ(rows[2]["outcome"], "success");
}

TEST(EnsembleVerb, RefusesWhatNoMemberCanHave) {
  expectOneLine({{2, {"ensemble", "kepler", "--set", "e=0.5..1.5:3"}, "0.99"},
                 {2, {"ensemble", "kepler", "--set", "a=1"}, "'a'"},
                 {2, {"ensemble", "kepler", "--start", "q3=1"}, "'q3'"},
                 {2, {"ensemble", "kepler", "--start", "q1=x"}, "'x'"},
                 {2, {"ensemble", "kepler", "--start", "q1=1,x"}, "'x'"},
                 {2, {"ensemble", "kepler", "--method", "gauss_333"}, "gauss_333"},
                 {2, {"ensemble", "kepler", "--method", "radau_iia"}, "radau_iia_5"},
                 {2, {"ensemble", "kepler", "--threads", "2"}, "--jobs"},
                 {2, {"ensemble", "kepler", "--reference"}, "references"},
                 {2, {"ensemble", "pendulum", "--constraints", "independent", "--start", "x=1"}, "independent"},
                 {2, {"ensemble", "kepler", "--single"}, "--single"}});
}

}  // namespace
}  // namespace irk
