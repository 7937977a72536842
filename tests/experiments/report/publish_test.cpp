// What irk publish writes and refuses, and the comparison of two publications.
#include "experiments/report/publish/publish.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "experiments/compare/publications.h"
#include "experiments/report/publish/published_page.h"
#include "experiments/report/publish/published_runs.h"
#include "experiments/report/publish/published_tables.h"
#include "experiments/store/store.h"
#include "experiments/tables/build_info.h"
#include "tests/experiments/columns_page.h"
#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

using report::publishedRuns;

std::string ownCode() { return std::string(buildInfo().code) + " (12 rows)"; }

class Publish : public testing::Test {
 protected:
  // The head of a study's runs.csv, which is all that is read of it.
  void writeRuns(const std::string& study, const std::string& code, const TableHead& more = {}) const {
    TableHead head{{"study", study},
                   {"code", code},
                   {"version", "1.2.3"},
                   {"commit", "abc"},
                   {"date", "2026-01-01T00:00:00Z to 2026-01-02T00:00:00Z"},
                   {"cpu", "A processor"}};
    head.insert(head.end(), more.begin(), more.end());
    writeTable(results() / study / "runs.csv", {head, {"outcome"}, {}});
  }
  std::filesystem::path results() const { return folder_.path() / "results"; }
  ReportOptions options() const { return {results(), IRK_SOURCE_DIR}; }

  TemporaryFolder folder_;
};

TEST_F(Publish, ReadsWhereTheRunsComeFrom) {
  writeRuns("order", ownCode());
  const auto runs = publishedRuns(options(), {"order"});
  ASSERT_EQ(runs.table.rows.size(), 1u);
  const auto cell = [&](const char* column) { return runs.table.rows.front()[runs.table.column(column)]; };
  EXPECT_EQ(cell("runs"), "12");
  EXPECT_EQ(cell("code"), buildInfo().code);
  EXPECT_EQ(cell("version"), "1.2.3");
  EXPECT_EQ(cell("cpu"), "A processor");
  EXPECT_EQ(headEntry(runs.table.head, "date"), "2026-01-02T00:00:00Z") << "that of the results, not of today";
}

TEST_F(Publish, NamesEveryStudyThatCannotBePublished) {
  writeRuns("order", "0123456789ab (12 rows, stale)");
  writeRuns("drift", ownCode() + ", 0123456789ab (1 rows, stale)");
  writeRuns("beam", ownCode(), {{std::string(store::kTimesRefused), "of two processors"}});
  const auto text = failureOf([&] { (void)publishedRuns(options(), {"order", "heat", "drift", "beam"}); });
  EXPECT_TRUE(containsAll(text, {"missing (irk paper", ": heat;", std::string(buildInfo().code), ": order, drift;",
                                 "several processors: beam"}));
}

TEST_F(Publish, AsksForThePaperAndTheAudit) {
  std::filesystem::create_directories(results() / "quick");
  const Ended full = program({"publish", folder_.path() / "new", "--results", results()});
  EXPECT_EQ(full.status, 1);
  EXPECT_TRUE(containsAll(full.err, {"scenes, order", "failure_newton, audit"}));
  const Ended quick = program({"publish", folder_.path() / "new", "--results", results() / "quick"});
  EXPECT_EQ(quick.status, 2);
  EXPECT_TRUE(containsAll(quick.err, {"quick runs", "publish --quick"}));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "new"));
}

TEST_F(Publish, LeavesAFolderWithOtherFilesAlone) {
  std::ofstream(folder_.path() / "mine.txt") << "mine";
  std::ostringstream err;
  const auto text = misuseOf([&] { (void)report::publish(options(), {}, folder_.path(), err); });
  EXPECT_TRUE(containsAll(text, {folder_.path(), "published.csv"}));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "mine.txt"));
}

TEST_F(Publish, DrawsTenToFifteenFiguresOfTheReport) {
  const auto chosen = report::publishedFigures();
  EXPECT_GE(chosen.size(), 10u);
  EXPECT_LE(chosen.size(), 15u);
  const auto all = readFigures(std::filesystem::path(IRK_SOURCE_DIR) / "plots" / "figures.txt");
  for (const auto& figure : chosen) {
    EXPECT_NE(std::ranges::find(all, figure.name, &Figure::name), all.end()) << figure.name;
  }
}

// The key of a table consists of columns that it has.
TEST_F(Publish, TablesHaveTheirKeys) {
  const auto tables = pageTables();
  for (const auto& table : report::publishedTables()) {
    // `orders` is the name of an answer and of a table of a study: the page has the answer later.
    const std::string name(table.name);
    const auto text = std::find_if(tables.rbegin(), tables.rend(), [&](const PageTable& one) {
      return one.file == name + ".csv" || one.file == "report/answers_" + name + ".csv";
    });
    ASSERT_NE(text, tables.rend()) << name;
    std::istringstream keys{std::string(table.key)};
    for (std::string key; keys >> key;) {
      EXPECT_NE(std::ranges::find(text->columns, key), text->columns.end()) << name << ' ' << key;
    }
  }
}

TEST_F(Publish, ThePageHasAnswersFiguresAndOrigin) {
  writeRuns("order", ownCode());
  report::Answer answer{.id = "orders", .question = "Which order?", .sentences = {"All `agree`."}};
  answer.shown = {
      .caption = "Orders", .titles = {"system", "order"}, .rows = {{{"ODE", "<span class=\"x\">a|b</span>"}}}};
  std::vector<Figure> figures;
  for (const auto& figure : report::publishedFigures())
    figures.push_back({"", "", std::string(figure.name), "Title of " + std::string(figure.name), "Caption.", ""});
  const auto runs = publishedRuns(options(), {"order"});
  const std::string page = report::publishedPage(options(), {answer}, figures, runs);
  EXPECT_TRUE(containsAll(
      page, {"## Which order?\n\nAll `agree`.\n", "| ODE | a\\|b |", "![Title of order_ode](figures/order_ode.svg)",
             "| runs | 12 in 1 studies |", "2026-01-01T00:00:00Z to 2026-01-02T00:00:00Z", "(tables/claims.csv)"}));
  EXPECT_EQ(page.find("figures/profile.svg"), page.npos) << "it belongs to another answer";
  EXPECT_EQ(page.find("quick"), page.npos);
  const ReportOptions quick{folder_.path() / "quick", IRK_SOURCE_DIR};
  EXPECT_TRUE(containsAll(report::publishedPage(quick, {answer}, figures, runs), {"**A quick run**", "(Quick run:"}));
}

// --- Comparison.

class PublicationComparison : public testing::Test {
 protected:
  static Table made() {
    return {{{"key", "solver tolerance"}},
            {"solver", "tolerance", "right", "time", "verdict"},
            {{"a", "1e-3", "10", "1.5", "good"}, {"a", "1e-6", "9", "nan", "good"}, {"b", "1e-3", "8", "3", "bad"}}};
  }
  std::string write(const std::string& name, const Table& table, const TableHead& more = {}) const {
    const auto folder = folder_.path() / name;
    TableHead head{{"version", name}, {"code", "abc"}};
    head.insert(head.end(), more.begin(), more.end());
    writeTable(folder / "published.csv", {head, {"study"}, {}});
    writeTable(folder / "tables" / "solvers.csv", table);
    return folder;
  }
  TemporaryFolder folder_;
};

TEST_F(PublicationComparison, FindsNothingInEqualTables) {
  const auto found = compare::comparePublications(write("one", made()), write("two", made()), {});
  EXPECT_EQ(found.count, 0u) << found.text;
  EXPECT_TRUE(containsAll(found.text, {"version one", "version two"}));
}

TEST_F(PublicationComparison, FindsRowsTextsAndNumbers) {
  Table other = made();
  other.rows[0][3] = "2.9";  // a factor below 2
  other.rows[1][2] = "4";
  other.rows[1][4] = "poor";
  other.rows[2][0] = "c";
  const auto found = compare::comparePublications(write("one", made()), write("two", other), {});
  EXPECT_EQ(found.count, 3u) << found.text;
  EXPECT_TRUE(containsAll(found.text, {"a 1e-6: right 9 -> 4, verdict good -> poor", "b 1e-3: only in the first",
                                       "c 1e-3: only in the second"}));
  EXPECT_EQ(found.text.find("2.9"), found.text.npos);
  EXPECT_EQ(program({"compare", folder_.path() / "one", folder_.path() / "two"}).status, 1);
}

TEST_F(PublicationComparison, SaysWhatItNeeds) {
  const auto one = write("one", made()), quick = write("two", made(), {{"quick", "small"}});
  EXPECT_TRUE(
      containsAll(misuseOf([&] { (void)compare::comparePublications(one, quick, {}); }), {one, quick, "quick"}));
  Table no_key = made();
  no_key.head.clear();
  EXPECT_TRUE(containsAll(misuseOf([&] { (void)compare::comparePublications(write("three", no_key), one, {}); }),
                          {"solvers.csv", "# key"}));
  std::filesystem::create_directories(folder_.path() / "results");
  const Ended mixed = program({"compare", one, folder_.path() / "results"});
  EXPECT_EQ(mixed.status, 2);
  EXPECT_TRUE(containsAll(mixed.err, {"is a publication", "is not"}));
}

}  // namespace
}  // namespace irk
