// Of a large table, a figure gets the rows and columns that it draws.
#include "experiments/report/drawn_rows.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/experiments/report/drawn.h"

namespace irk {
namespace {

const std::vector<std::string> kColumns{
    "key",     "scene", "settings",  "method",  "family",          "stages",          "newton",
    "rtol",    "atol",  "control",   "outcome", "error",           "error_u",         "error_v",
    "error_x", "cpu_s", "residuals", "detail",  "reference_times", "error_over_time", "block"};

class Drawn : public testing::Test {
 protected:
  // Rows of two blocks, two scenes and three Newton methods; errors and times all over nine decades.
  void write(std::size_t rows) {
    std::mt19937 random(1);
    Table table{{{"study", "made_up"}}, kColumns, {}};
    const auto anywhere = [&] { return exact(std::pow(10, -9 * static_cast<double>(random()) / random.max())); };
    for (std::size_t i = 0; i < rows; ++i) {
      const std::string error = anywhere();
      const bool failed = i % 10 == 9;
      table.rows.push_back({std::to_string(i),
                            i % 2 ? "kepler" : "pendulum",
                            "e=" + std::to_string(i),
                            "gauss_2",
                            "gauss",
                            "2",
                            i % 3 == 0   ? "full"
                            : i % 3 == 1 ? "modified"
                                         : "simplified",
                            "1e-6",
                            "1e-6",
                            "predictive",
                            failed ? "max_steps" : "success",
                            failed ? "nan" : error,
                            "nan",
                            "nan",
                            failed ? "nan" : error,
                            anywhere(),
                            "100",
                            "a text, with a comma",
                            "1",
                            "nan",
                            i < rows / 2 ? "one" : "one two"});
    }
    writeTable(results() / "runs.csv", table);
    writeTable(results() / "orders.csv", {{}, {"order"}, {{"2"}}});
  }
  std::filesystem::path results() const { return folder_.path() / "made_up"; }
  Figure figure(const std::string& script, const std::string& assignments) const {
    return {"made_up", script + ".gp", "figure", "", "", assignments, true};
  }
  DrawnRows drawn(const std::string& script, const std::string& assignments) const {
    return DrawnRows(figure(script, assignments), IRK_SOURCE_DIR, results());
  }
  TemporaryFolder folder_;
};

TEST_F(Drawn, SelectsRowsAndColumns) {
  write(600);
  const auto rows = [&](const std::string& assignments) {
    const DrawnRows some = drawn("over_step", assignments);  // draws every row
    const Table table = readTable(some.folder() / "runs.csv");
    EXPECT_EQ(table.rows.size(), some.rows());
    EXPECT_FALSE(table.hasColumn("detail"));
    EXPECT_TRUE(table.hasColumn("newton"));
    return some.rows();
  };
  EXPECT_EQ(rows(""), 600u);
  EXPECT_EQ(rows("block='two'"), 300u);
  EXPECT_EQ(rows("block='one'"), 600u);
  EXPECT_EQ(rows("scene='kepler'"), 300u);
  EXPECT_EQ(rows("block='two'; scene='kepler'"), 150u);
  EXPECT_EQ(rows("newton='full'"), 200u);
  EXPECT_EQ(rows("only='outcome=max_steps scene=kepler'"), 60u);
  EXPECT_EQ(rows("only=\"'error=' scene=kepler\""), 60u) << "without an error";
  EXPECT_EQ(rows("by='newton scaling'"), 600u) << "no selection";
  EXPECT_EQ(rows("cases='block=two:kepler block=nothing'"), 150u);
  EXPECT_EQ(rows("cases='kepler:e=7 pendulum:e=8'"), 2u);
}

TEST_F(Drawn, HasTheOtherTables) {
  write(10);
  const DrawnRows some = drawn("error_vs_step", "");
  EXPECT_EQ(readTable(some.folder() / "orders.csv").rows.size(), 1u);
}

TEST_F(Drawn, LeavesOutMarksBesideOthers) {
  constexpr std::size_t kRows = 60'000;
  write(kRows);
  const DrawnRows some = drawn("work_by", "variant='newton'; cases='block=one'");
  const Table table = readTable(some.folder() / "runs.csv");
  EXPECT_LE(table.rows.size(), DrawnRows::kMostRows);
  EXPECT_GT(table.rows.size(), DrawnRows::kMostRows / 2) << "no coarser than needed";
  // Marks of all curves and outcomes are there, and near every mark there is one.
  std::map<std::string, std::set<std::pair<int, int>>> places;  // fifths of decades
  const auto fifth = [](double x) { return static_cast<int>(std::floor(5 * std::log10(x))); };
  std::set<std::string> curves;
  for (const auto& row : table.rows) {
    curves.insert(row[table.column("newton")] + row[table.column("outcome")]);
    const double error = std::strtod(row[table.column("error")].c_str(), nullptr);
    if (error > 0) {
      places[row[table.column("newton")]].insert(
          {fifth(error), fifth(std::strtod(row[table.column("cpu_s")].c_str(), nullptr))});
    }
  }
  EXPECT_EQ(curves.size(), 6u);
  for (const auto& [newton, its] : places) EXPECT_GT(its.size(), 1900u) << newton << ", of 2025";
}

// The figure of few rows is the same, whether they are selected before or by gnuplot.
TEST_F(Drawn, ChangesNoFigureOfFewRows) {
  write(60);
  for (const std::string script : {"work_by", "work_precision"}) {
    const std::string options =
        script == "work_by" ? "variant='newton'; cases='block=two'" : "block='two'; family='gauss'";
    const DrawnRows some = drawn(script, options);
    std::string pictures[2];
    for (const bool reduced : {false, true}) {
      const auto out = folder_.path() / ("figure" + std::to_string(reduced));
      std::ostringstream err;
      ASSERT_TRUE(drawFigure(
          script + ".gp",
          fmt::format("data='{}'; out='{}'; {}", (reduced ? some.folder() : results()).string(), out.string(), options),
          IRK_SOURCE_DIR, err))
          << err.str();
      pictures[reduced] = readInputFile(out.string() + ".svg");
    }
    EXPECT_FALSE(pictures[0].empty());
    EXPECT_EQ(pictures[0], pictures[1]) << script;
  }
}

}  // namespace
}  // namespace irk
