// The pages of the guide that repeat what the program knows: outcomes and columns.
#include <gtest/gtest.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "experiments/runs/block_names.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run_table.h"
#include "irk/outcome.h"
#include "tests/experiments/columns_page.h"
#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

// The first cells of the page's rows: `| `name` | …`.
std::set<std::string> namedRows(const std::string& page) {
  std::set<std::string> names;
  const std::string begin = "\n| `";
  for (std::size_t at = page.find(begin); at != page.npos; at = page.find(begin, at + 1)) {
    const std::size_t from = at + begin.size();
    names.insert(page.substr(from, page.find('`', from) - from));
  }
  return names;
}

TEST(Guide, TheOutcomesAreThoseOfTheProgram) {
  std::set<std::string> outcomes{"refused", "exception"};  // in sweeps, instead of a message
  outcomes.insert(std::begin(kOutcomeNames), std::end(kOutcomeNames));
  EXPECT_EQ(outcomes.size(), std::size(kOutcomeNames) + 2);
  static_assert(name(Outcome::kNewtonFailed) == "newton_failed" && name(Outcome::kNotFinite) == "not_finite" &&
                name(Outcome::kSingular) == "singular" && name(Outcome::kStalled) == "stalled" &&
                name(Outcome::kNoEvent) == "no_event" && name(Outcome::kInaccurate) == "inaccurate");
  EXPECT_EQ(namedRows(guidePage("outcomes.md")), outcomes);
}

TEST(Guide, TheProgramPrintsThePageOfTables) {
  const auto run = program({"list", "columns"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(run.out.starts_with("## runs.csv\n"));
  EXPECT_TRUE(guidePage("tables.md").ends_with("\n\n" + run.out));
}

// A setting has the meaning that `--help` and `irk list` print.
TEST(Guide, EachColumnOfRunsHasOneMeaning) {
  const auto tables = pageTables();
  const auto runs = std::ranges::find(tables, "runs.csv", &PageTable::file);
  ASSERT_NE(runs, tables.end());
  auto columns = runColumns();
  columns.emplace_back(kBlockColumn);
  EXPECT_EQ(runs->columns, columns);
  for (const auto& field : specFields()) {
    const auto column = std::ranges::find(runs->columns, field.name);
    if (column == runs->columns.end()) continue;  // it is no column
    EXPECT_EQ(runs->meanings[static_cast<std::size_t>(column - runs->columns.begin())], field.meaning) << field.name;
  }
  for (const auto& meaning : runs->meanings) EXPECT_TRUE(meaning.ends_with('.')) << meaning;
}

std::vector<std::string> columnsSaid(const std::string& file, const Table& runs) {
  std::vector<std::string> columns;
  for (const auto& table : pageTables()) {
    if (table.file != file) continue;
    if (table.begins_with_series) columns = seriesColumns(runs);
    columns.insert(columns.end(), table.columns.begin(), table.columns.end());
  }
  return columns;
}

constexpr char kManyTables[] = R"(
orders = true
targets = [1e-2, 1e-4]
profile = true
ratios = true
robustness = true
energy = true
scaling = true
phases = true
contractions = true
estimates = true
[timing]
min_time_s = 0.0001
repetitions = 1
[[block]]
name = "tolerances"
scene = "kepler"
t_end = 0.1
methods = ["radau_iia_2", "radau_iia_3"]
newton = ["modified", "simplified"]
tolerances = [1e-3, 1e-4]
[[block]]
name = "steps"
scene = "kepler"
t_end = 0.1
methods = "gauss_2"
steps = [0.05, 0.025, 0.0125]
)";

// Each table that these analyses write has the columns that the page says, in their order.
TEST(Guide, TablesHaveTheColumnsThatItSays) {
  const TemporaryFolder folder;
  const std::string results = folder.path() / "results", study = folder.path() / "many.toml";
  std::ofstream(study) << kManyTables;
  const auto run = program({"run", study, "--results", results, "--jobs", "2"});
  const Table runs = readTable(results + "/many/runs.csv");
  int tables = 0;
  for (const auto& entry : std::filesystem::directory_iterator(results + "/many")) {
    const std::string file = entry.path().filename();
    if (entry.path().extension() != ".csv" || file == "runs.csv") continue;
    EXPECT_EQ(readTable(entry.path()).columns, columnsSaid(file, runs)) << file;
    ++tables;
  }
  EXPECT_GE(tables, 13) << run.out << run.err;
}

}  // namespace
}  // namespace irk
