#include "experiments/runs/run_table.h"
#include "experiments/runs/block_names.h"

#include <gtest/gtest.h>

#include <sstream>

#include "experiments/runner/runner.h"
#include "experiments/study/study_reader.h"
#include "tests/experiments/study_runs.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

// A table of an older version with fewer columns is read with the columns that it has.
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

// Runs of another version are made again, and its rows are kept.
TEST(RunTable, ATableOfAnotherVersionIsSetAside) {
  const TemporaryFolder folder;
  const Study study = parseStudy("[[block]]\nscene = \"kepler\"\nt_end = 0.1\nmethods = \"gauss_2\"\nsteps = 0.05\n",
                                 "small.toml", StudyVariant::kFull);
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
