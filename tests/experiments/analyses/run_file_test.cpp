// Tables that are read series by series, against the same tables in memory.
#include "experiments/analyses/run_file.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "experiments/runs/block_names.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

// Two blocks with a common run, two scenes, failures, a solver that is refused, a word with a comma, no reference.
constexpr char kMixed[] = R"(
targets = [1e-2, 1e-4, 1e-6, 1e-12]
ratios = true
robustness = true

[[block]]
name = "rules"
scene = "van_der_pol"
t_end = 0.5
reference = "auto"
methods = ["radau_iia_2", "radau_iia_3"]
newton = ["simplified", "modified"]
estimate = ["embedded", "richardson"]
tolerances = [1e-3, 1e-5, 1e-7]

[[block]]
name = "more"
scene = "van_der_pol"
t_end = 0.5
reference = "auto"
methods = ["radau_iia_3", "cvode_bdf"]
tolerances = [1e-4, 1e-5]

[[block]]
name = "few_steps"
scene = "hires"
max_steps = 10
methods = ["gauss_2", "gauss_3"]
newton = ["simplified", "modified"]
tolerances = [1e-2, 1e-6]

[[block]]
name = "refused"
scene = "pendulum"
formulation = "index3"
methods = ["cvode_bdf", "radau_iia_3"]
tolerances = [1e-3]
)";

class WholeTables : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made_ = new StudyRuns(runsOf(kMixed));
    // Rows in another order: no two rows of a series follow each other.
    auto& rows = made_->runs.rows;
    std::vector<TableRow> mixed;
    for (const std::size_t start : {1u, 0u, 2u}) {
      for (std::size_t i = start; i < rows.size(); i += 3) mixed.push_back(rows[i]);
    }
    mixed[3][made_->runs.column("detail")] = "a \"quoted\" word, and\na line";
    rows = std::move(mixed);
    file_ = new TemporaryFolder;
    writeTable(file(), runs());
  }
  static void TearDownTestSuite() {
    delete made_;
    delete file_;
  }
  static const Table& runs() { return made_->runs; }
  static const std::vector<double>& targets() { return made_->study.targets; }
  static std::filesystem::path file() { return file_->path() / "runs.csv"; }

  static inline StudyRuns* made_;
  static inline TemporaryFolder* file_;
};

TEST_F(WholeTables, SeriesHaveTheSameRowsInTheSameOrder) {
  const auto whole = seriesOf(runs());
  const RunFile read(file());
  ASSERT_EQ(read.size(), whole.size());
  ASSERT_GT(whole.size(), 10u);
  EXPECT_EQ(read.rows(), runs().rows.size());
  for (const std::size_t first : {std::size_t{3}, std::size_t{0}}) {  // in any order
    for (std::size_t i = first; i < whole.size(); ++i) {
      const auto held = read[i];
      EXPECT_EQ(held.series.name, whole[i].name);
      EXPECT_EQ(held.series.blocks, whole[i].blocks);
      EXPECT_EQ(read.find(whole[i].name), i);
      ASSERT_EQ(held.series.rows.size(), whole[i].rows.size());
      for (std::size_t k = 0; k < held.rows.size(); ++k) EXPECT_EQ(*held.series.rows[k], *whole[i].rows[k]);
    }
  }
  auto unknown = whole[0].name;
  unknown.back() += "?";
  EXPECT_EQ(read.find(unknown), std::nullopt);
  std::vector<TableRow> rows;
  read.forEachRow([&](const TableRow& row) { rows.push_back(row); });
  EXPECT_EQ(rows, runs().rows);
}

// Each key is a group, and a second row with a key belongs to its group.
TEST_F(WholeTables, GroupsAreFoundByTheirNames) {
  Table twice = runs();
  twice.rows.push_back(twice.rows[2]);
  ofFile(twice, [&](const auto& path) {
    const GroupedFile by_key(path, {"key"});
    EXPECT_EQ(by_key.size(), runs().rows.size());
    for (std::size_t i = runs().rows.size(); i-- > 0;) {
      const auto group = by_key.find({runs().rows[i].front()});
      EXPECT_EQ(group, i);
      EXPECT_EQ(by_key.group(i), std::vector<TableRow>(i == 2 ? 2 : 1, runs().rows[i]));
    }
    EXPECT_EQ(by_key.find({"0"}), std::nullopt);
    return 0;
  });
}

// Rows of several groups that do not follow each other.
TEST_F(WholeTables, RowsOfGroupsComeInTheOrderOfTheFile) {
  const auto method = runs().column("method"), outcome = runs().column("outcome");
  const GroupedFile grouped(file(), {"method", "outcome"});
  std::vector<std::size_t> groups;
  for (std::size_t i = grouped.size(); i-- > 0;) {
    if (grouped.firstRow(i)[outcome] == "success") groups.push_back(i);
  }
  ASSERT_GT(groups.size(), 1u);
  std::vector<TableRow> rows, expected;
  grouped.forEachRowOf(groups, [&](TableRow row) { rows.push_back(std::move(row)); });
  for (const auto& row : runs().rows) {
    if (row[outcome] == "success") expected.push_back(row);
  }
  EXPECT_EQ(rows, expected);
  EXPECT_EQ(grouped.nameOf(rows.front()), (TableRow{rows.front()[method], "success"}));
  EXPECT_TRUE(containsAll(misuseOf([] { GroupedFile(file(), {"metod"}); }), {"metod", "did you mean 'method'"}));
}

// All pairs of series of a block, compared by their cells.
Table plainRatios(const Table& runs, const std::vector<double>& targets) {
  Table ratios{{}, {}, {}};
  const auto columns = seriesColumns(runs);
  const auto all = seriesOf(runs);
  const auto isIn = [](const std::string& name, const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const std::string block : {"more", "rules", "few_steps", "refused"}) {
    std::vector<const RunSeries*> its;
    for (const auto& one : all) {
      if (hasBlock(one.blocks, block)) its.push_back(&one);
    }
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (isIn(columns[c], {"scene", "settings", "method", "family", "stages", "integrator", "t_end"})) continue;
      for (const auto* other : its) {
        for (const auto* base : its) {
          auto name = other->name;
          name[c] = its.front()->name[c];
          if (other == base || name == other->name || base->name != name) continue;
          TableRow row{block, textAt(runs, *base->rows.front(), "scene"), columns[c], other->name[c], base->name[c]};
          int both = 0, lost = 0, won = 0;
          for (const double target : targets) {
            const double a = seriesCostAtError(runs, *base, "residuals", target);
            const double b = seriesCostAtError(runs, *other, "residuals", target);
            both += !std::isnan(a) && !std::isnan(b);
            lost += !std::isnan(a) && std::isnan(b);
            won += std::isnan(a) && !std::isnan(b);
          }
          for (const int count : {both, lost, won}) row.push_back(std::to_string(count));
          ratios.rows.push_back(row);
        }
      }
    }
  }
  std::sort(ratios.rows.begin(), ratios.rows.end());
  return ratios;
}

TEST_F(WholeTables, RatiosAreThoseOfAllPairs) {
  const Table ratios = ratioTable(runs(), targets());
  std::vector<TableRow> found;
  for (const auto& row : ratios.rows) {
    TableRow cells;
    for (const char* column : {"block", "scene", "column", "value", "base", "errors", "lost", "won"}) {
      cells.push_back(textAt(ratios, row, column));
    }
    found.push_back(cells);
  }
  std::sort(found.begin(), found.end());
  // Of `rules` two methods with two estimates for newton, with two rules of Newton for estimate; of `few_steps` two
  // methods.
  EXPECT_EQ(found.size(), 4u + 4u + 2u);
  EXPECT_EQ(found, plainRatios(runs(), targets()).rows);
}

}  // namespace
}  // namespace irk
