// The pages of the guide that repeat what the program knows: outcomes and columns.
#include <gtest/gtest.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "experiments/commands/columns/column_texts.h"
#include "experiments/runs/block_names.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run_table.h"
#include "irk/outcome.h"
#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

std::string guidePage(const std::string& name) { return readInputFile(IRK_SOURCE_DIR "/experiments/guide/" + name); }

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
  std::set<std::string> outcomes{"refused"};  // in sweeps, instead of a message
  for (int i = 0; name(static_cast<Outcome>(i)) != "?"; ++i) outcomes.emplace(name(static_cast<Outcome>(i)));
  EXPECT_GE(outcomes.size(), 14u);
  EXPECT_EQ(namedRows(guidePage("outcomes.md")), outcomes);
}

TEST(Guide, ThePageOfTablesIsWhatTheProgramPrints) {
  const auto run = program({"list", "columns"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(guidePage("tables.md").ends_with(".\n\n" + run.out))
      << "irk list columns has changed: replace its output at the end of experiments/guide/tables.md";
}

TEST(Guide, EachColumnOfRunsHasOneMeaning) {
  std::set<std::string> columns, fields, texts;
  for (const auto& column : runColumns()) columns.insert(column);
  columns.emplace(kBlockColumn);
  for (const auto& field : specFields()) fields.insert(field.name);
  for (const auto& text : runColumnTexts()) {
    EXPECT_TRUE(columns.contains(std::string(text.name))) << "no such column: " << text.name;
    EXPECT_FALSE(fields.contains(std::string(text.name))) << "said twice: " << text.name;
    EXPECT_TRUE(texts.emplace(text.name).second) << "said twice: " << text.name;
    EXPECT_TRUE(text.meaning.ends_with('.')) << text.name;
  }
  for (const auto& column : columns) EXPECT_TRUE(texts.contains(column) || fields.contains(column)) << column;
}

std::vector<std::string> columnsSaid(const std::string& file, const Table& runs) {
  std::vector<std::string> columns;
  for (const auto& list : {tableTexts(), summaryTableTexts()}) {
    for (const auto& table : list) {
      if (table.file != file) continue;
      if (table.begins_with == SharedColumns::kSeries) columns = seriesColumns(runs);
      for (const auto& text : table.columns) columns.emplace_back(text.name);
    }
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

// Each table that these analyses write has the columns that the guide says, in their order.
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
