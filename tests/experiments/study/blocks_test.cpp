// Names of a study's blocks: how they are read and written, and that they do not affect runs.
#include "experiments/runs/block_names.h"

#include <gtest/gtest.h>

#include <set>

#include "experiments/analyses/costs/cost_at_error.h"
#include "experiments/analyses/orders/orders.h"
#include "experiments/report/report.h"
#include "experiments/study/builtin_studies.h"
#include "experiments/study/study_reader.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/stored_runs.h"

namespace irk {
namespace {

// Two blocks that share radau_iia_2.
constexpr char kTwo[] = R"(
[[block]]
name = "few"
scene = "kepler"
t_end = 0.5
methods = "radau_iia_2"
tolerances = [1e-3, 1e-4]
[[block]]
name = "more"
scene = "kepler"
t_end = 0.5
methods = ["radau_iia_2", "gauss_2"]
tolerances = [1e-3, 1e-4]
)";

Study parseBlocks(const std::string& toml) { return parseStudy(toml, "mine.toml", StudyVariant::kFull); }

TEST(Blocks, AreNamedOrNumbered) {
  const std::string block = "[[block]]\nscene = \"kepler\"\nmethods = \"gauss_2\"\n";
  const Study study =
      parseBlocks(block + "[[block]]\nname = \"orbit\"\nscene = \"kepler\"\nmethods = \"gauss_3\"\n" + block);
  ASSERT_EQ(study.series.size(), 3u);
  EXPECT_EQ(study.series[0].block, "block_1");
  EXPECT_EQ(study.series[1].block, "orbit");
  EXPECT_EQ(study.series[2].block, "block_3");
}

TEST(Blocks, BadNamesAreRefusedWithTheirLine) {
  const std::string body = "scene = \"kepler\"\nmethods = \"gauss_2\"\n";
  const auto misuse = [](const std::string& toml) { return misuseOf([&] { parseBlocks(toml); }); };
  const auto named = [&](const std::string& name) { return misuse("[[block]]\n" + body + "name = " + name + "\n"); };
  EXPECT_TRUE(containsAll(named("\"two words\""), {"mine.toml:4", "name", "'two words'", "letters, digits and _"}));
  EXPECT_TRUE(containsAll(named("\"\""), {"mine.toml:4", "name"}));
  EXPECT_TRUE(containsAll(named("[\"a\", \"b\"]"), {"mine.toml:4", "name", "not a list"}));
  EXPECT_TRUE(containsAll(misuse("[[block]]\nname = \"a\"\n" + body + "[[block]]\nname = \"a\"\n" + body),
                          {"mine.toml:6", "'a' is another block's name"}));
  EXPECT_TRUE(containsAll(misuse("[[block]]\nname = \"block_2\"\n" + body + "[[block]]\n" + body),
                          {"mine.toml:5", "'block_2' is another block's name"}));
  EXPECT_TRUE(containsAll(misuse("[defaults]\nname = \"a\"\n[[block]]\n" + body), {"mine.toml:2", "[defaults]"}));
  EXPECT_TRUE(containsAll(misuse("[quick]\nname = \"a\"\n[[block]]\n" + body), {"mine.toml:2", "[quick]"}));
  EXPECT_TRUE(
      containsAll(misuse("[[block]]\n" + body + "[block.quick]\nname = \"a\"\n"), {"mine.toml:5", "[block.quick]"}));
}

TEST(Blocks, WordsOfAColumn) {
  EXPECT_TRUE(hasBlock("few more", "few"));
  EXPECT_TRUE(hasBlock("few more", "more"));
  EXPECT_FALSE(hasBlock("few more", "mor"));
  EXPECT_FALSE(hasBlock("few more", ""));
  EXPECT_FALSE(hasBlock("", ""));
  std::string names = "few";
  addBlocks(names, "more few");
  EXPECT_EQ(names, "few more");
}

class BlockColumn : public StoredRuns {};

TEST_F(BlockColumn, NamesEveryBlockOfARun) {
  const Table runs = run("results", {}, kTwo);
  ASSERT_EQ(runs.rows.size(), 4u);
  EXPECT_EQ(runs.columns.back(), kBlockColumn);
  for (const auto& row : runs.rows) {
    EXPECT_EQ(row.back(), textAt(runs, row, "method") == "gauss_2" ? "more" : "few more");
  }
  const Table costs = costTable(runs, {1e-2});
  ASSERT_EQ(costs.rows.size(), 2u);
  EXPECT_EQ(textAt(costs, costs.rows[0], kBlockColumn), "few more");
  EXPECT_EQ(textAt(costs, costs.rows[1], kBlockColumn), "more");
}

// Two series of tolerances in two blocks form one series of runs; its row names both blocks.
TEST_F(BlockColumn, ASeriesOfTwoBlocksNamesBoth) {
  std::string halves(kTwo);
  halves.replace(halves.rfind("[1e-3, 1e-4]"), 12, "[1e-5, 1e-6]");
  const Table runs = run("results", {}, halves);
  const Table costs = costTable(runs, {1e-2});
  ASSERT_EQ(costs.rows.size(), 2u);
  EXPECT_EQ(textAt(costs, costs.rows[0], kBlockColumn), "few more");
}

TEST_F(BlockColumn, IsNoPartOfARun) {
  run("results", {}, kTwo);
  EXPECT_EQ(made(), 4);
  std::string renamed(kTwo);
  renamed.replace(renamed.find("few"), 3, "first");
  const Table runs = run("results", {}, renamed);
  EXPECT_EQ(made(), 0) << "another name needs no other run";
  EXPECT_EQ(runs.rows[0].back(), "first more");
  for (const auto& part : partsOf(folder())) EXPECT_FALSE(readTable(part).hasColumn(kBlockColumn));
}

TEST(Blocks, OrdersNameThem) {
  const auto [study, runs] = runsOf(R"(
orders = true
[[block]]
name = "tracking"
scene = "riccati_tracking"
methods = "gauss_1"
refine_most = 64
)");
  const Table orders = orderTable(runs);
  ASSERT_EQ(orders.rows.size(), 1u);
  EXPECT_EQ(textAt(orders, orders.rows[0], kBlockColumn), "tracking");
}

// All blocks that figures name exist in their studies.
TEST(Blocks, OfFiguresExist) {
  for (const auto& figure : readFigures(std::filesystem::path(IRK_SOURCE_DIR) / "plots/figures.txt")) {
    constexpr std::string_view kStart = "block=";
    const std::string& text = figure.assignments;
    std::set<std::string> blocks;
    for (auto at = text.find(kStart); at != text.npos; at = text.find(kStart, at + 1)) {
      if (blocks.empty()) {
        for (const auto& series : loadStudy(figure.study, StudyVariant::kQuick).series) blocks.insert(series.block);
      }
      auto from = at + kStart.size();
      if (text[from] == '\'') ++from;
      const std::string name = text.substr(from, text.find_first_of(" ':", from) - from);
      EXPECT_TRUE(blocks.contains(name)) << figure.name << " asks for the block " << name;
    }
  }
}

}  // namespace
}  // namespace irk
