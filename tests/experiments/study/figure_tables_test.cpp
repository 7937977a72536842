// Tables [[figure]] of a study file.
#include <gtest/gtest.h>

#include "experiments/study/study_reader.h"
#include "experiments/study/toml/figure_tables.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

std::string misuse(const std::string& text) {
  return misuseOf([&] { parseFigureTables(text, "mine.toml"); });
}

TEST(FigureTables, BecomeAssignmentsOfGnuplot) {
  const auto tables = parseFigureTables(R"(title = "Mine"
[[figure]]
script = "work_by"
name = "newton"
caption = "A \"quoted\" word"
variant = "newton"
columns = 3
extent = 0.5
stages = "3"
only = ["method=gauss_3", "settings=a=1 b=2"]
titles = ["one panel"]
cases = "kepler pendulum"
[[figure]]
script = "profile"
)",
                                        "mine.toml");
  EXPECT_EQ(tables.title, "Mine");
  ASSERT_EQ(tables.figures.size(), 2u);
  const auto& first = tables.figures.front();
  EXPECT_EQ(first.caption, "A \"quoted\" word");
  const std::string assignments = assignmentsOf(first.options);
  EXPECT_TRUE(containsAll(assignments, {"variant='newton'", "columns=3", "extent=0.5", "stages='3'",
                                        "only='method=gauss_3 \"settings=a=1 b=2\"'", "titles='\"one panel\"'",
                                        "cases='kepler pendulum'"}));
  EXPECT_EQ(tables.figures.back().name, "profile") << "the script's name by default";

  EXPECT_EQ(parseFigureTables("title = \"two\\nlines\"\n", "mine.toml").title, "two lines");

  const auto again = parseFigureTables(figureTablesText(tables), "again.toml");
  EXPECT_EQ(again.title, tables.title);
  ASSERT_EQ(again.figures.size(), 2u);
  EXPECT_EQ(again.figures.front().caption, first.caption);
  EXPECT_EQ(assignmentsOf(again.figures.front().options), assignments);
}

// Results may come from somebody else: their figures must not contain commands.
TEST(FigureTables, RefuseWhatGnuplotWouldExecute) {
  const std::string start = "[[figure]]\nscript = \"work_by\"\n";
  EXPECT_TRUE(containsAll(misuse(start + "only = \"a'; system 'ls\"\n"), {"mine.toml:3", "only", "' is not allowed"}));
  EXPECT_TRUE(containsAll(misuse(start + "only = [\"`ls`\"]\n"), {"mine.toml:3", "` is not allowed"}));
  EXPECT_TRUE(containsAll(misuse(start + "only = \"a\\nb\"\n"), {"mine.toml:3", "control character"}));
  EXPECT_TRUE(containsAll(misuse(start + "\"a=1; b\" = 3\n"), {"letters, digits and _"}));
  EXPECT_TRUE(containsAll(misuse(start + "name = \"../x\"\n"), {"mine.toml:3", "name = '../x'"}));
  EXPECT_TRUE(containsAll(misuse("[[figure]]\nscript = \"../../x\"\n"), {"mine.toml:2", "script"}));
}

TEST(FigureTables, RefuseMistakesWithTheirLine) {
  EXPECT_TRUE(containsAll(misuse("[[figure]]\nvariant = \"newton\"\n"), {"mine.toml:1", "without script"}));
  EXPECT_TRUE(containsAll(misuse("figure = 3\n"), {"mine.toml:1", "[[figure]]"}));
  EXPECT_TRUE(containsAll(misuse("[[figure]]\nscript = \"profile\"\n[[figure]]\nscript = \"profile\"\n"),
                          {"mine.toml:3", "'profile'", "mine.toml:1"}));
  const std::string block = "[[block]]\nscene = \"kepler\"\nmethods = \"gauss_2\"\n";
  EXPECT_TRUE(containsAll(
      misuseOf([&] { parseStudy(block + "[[figure]]\nvariant = \"h\"\n", "mine.toml", StudyVariant::kFull); }),
      {"mine.toml:4", "without script"}));
}

}  // namespace
}  // namespace irk
