#include "experiments/runs/block_names.h"
#include "experiments/runs/run_table.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "experiments/runner/runner.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

RunSpec plain() {
  RunSpec spec;
  spec.scene = "slider_crank";
  return resolved(spec);
}

// Another value of every field. A field that is new has to be added here.
const std::map<std::string, std::string> kOthers = {{"scene", "pendulum"},
                                                    {"settings", "torque_off_at=0.25"},
                                                    {"configuration", "embedded"},
                                                    {"method", "gauss_8"},
                                                    {"formulation", "index3"},
                                                    {"scaling", "off"},
                                                    {"discontinuity", "ignore"},
                                                    {"scalar", "mp50"},
                                                    {"derivatives", "difference_central"},
                                                    {"newton", "full"},
                                                    {"solver", "eigen"},
                                                    {"storage", "dense"},
                                                    {"predictor", "previous"},
                                                    {"estimate", "none"},
                                                    {"control", "paper"},
                                                    {"order", "variable"},
                                                    {"max_stages", "7"},
                                                    {"summation", "plain"},
                                                    {"multipliers", "stages"},
                                                    {"norm", "absolute"},
                                                    {"jacobian", "no_mass"},
                                                    {"jacobian_point", "middle"},
                                                    {"residual_tolerance", "1e-7"},
                                                    {"contractivity_limit", "0.25"},
                                                    {"contractivity_after", "7"},
                                                    {"max_iterations", "8"},
                                                    {"keep_jacobian_below", "0.5"},
                                                    {"kappa", "0.125"},
                                                    {"h", "0.25"},
                                                    {"h_max", "0.5"},
                                                    {"rtol", "1e-9"},
                                                    {"atol", "1e-9"},
                                                    {"t_end", "0.75"},
                                                    {"max_steps", "17"},
                                                    {"threads", "2"},
                                                    {"time_limit", "1.5"}};

TableRow rowOf(const RunSpec& spec) {
  RunRecord record;
  record.spec = spec;
  record.outcome = "success";
  return runRow(specKey(spec), "study", record);
}

// Two runs that differ in one field differ in their key, in that field's column, and lie in two series
// unless a series runs through the field.
TEST(RunTable, EveryFieldHasAColumnAndTellsSeriesApart) {
  const std::set<std::string> swept{"h", "rtol", "atol"};
  ASSERT_EQ(runColumns().size(), rowOf(plain()).size());
  for (const auto& field : specFields()) {
    const std::string name(field.name);
    ASSERT_TRUE(kOthers.contains(name)) << name << " is a new field: give it another value";
    RunSpec other = plain();
    field.set(other, kOthers.at(name));
    other = resolved(other);
    const Table runs{{}, runColumns(), {rowOf(plain()), rowOf(other)}};
    EXPECT_NE(runs.rows[0][0], runs.rows[1][0]) << name << ": the same key";
    ASSERT_TRUE(runs.hasColumn(name)) << name;
    EXPECT_EQ(textAt(runs, runs.rows[0], name), field.get(plain()));
    EXPECT_EQ(textAt(runs, runs.rows[1], name), field.get(other));
    EXPECT_NE(field.get(other), field.get(plain())) << name;
    EXPECT_EQ(seriesOf(runs).size(), swept.contains(name) ? 1u : 2u) << name;
  }
  EXPECT_EQ(kOthers.size(), specFields().size());
}

// A table of a version that had fewer columns is read by those that it has.
TEST(RunTable, OldTablesHaveTheirSeries) {
  Table runs{{}, {"scene", "method", "max_steps", "outcome"}, {}};
  runs.rows = {{"kepler", "gauss_2", "10", "success"},
               {"kepler", "gauss_2", "20", "success"},
               {"kepler", "gauss_2", "10", "timeout"}};
  EXPECT_EQ(seriesColumns(runs), (std::vector<std::string>{"scene", "method", "max_steps"}));
  const auto series = seriesOf(runs);
  ASSERT_EQ(series.size(), 2u);
  EXPECT_EQ(series[0].rows.size(), 2u);
}

// Its runs are made again, and its rows are still there.
TEST(RunTable, ATableOfAnotherVersionIsSetAside) {
  const TemporaryFolder folder;
  const Study study = parseStudy(
      "[[block]]\nscene = \"kepler\"\nt_end = 0.1\nmethods = \"gauss_2\"\nsteps = 0.05\n", "small.toml",
      StudyVariant::kFull);
  RunnerOptions options;
  options.results = folder.path();
  const auto results = folder.path() / "small";
  const Table old{{{"study", "small"}}, {"key", "scene"}, {{"0123", "kepler"}}};
  for (const char* name : {"runs.old.csv", "runs.old2.csv"}) {
    std::filesystem::remove_all(results / "parts");  // a version without parts
    writeTable(results / "runs.csv", old);
    std::ostringstream told;
    const Table runs = runStudy(study, options, told);
    ASSERT_EQ(runs.rows.size(), 1u);
    auto columns = runColumns();
    columns.emplace_back(kBlockColumn);
    EXPECT_EQ(runs.columns, columns);
    EXPECT_EQ(readTable(results / name).rows, old.rows);
    EXPECT_TRUE(containsAll(told.str(), {"runs.csv", "another version", name}));
  }
}

}  // namespace
}  // namespace irk
