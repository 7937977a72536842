// The report's page and the explorer in a browser, made by `irk run` and `irk report` from a small study of a user's.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/browser/browser.h"
#include "tests/experiments/program.h"

namespace irk {
namespace {

constexpr char kStudy[] = R"(
title = "Small"
targets = [1e-3, 1e-5]
orders = true
[[block]]
name = "tolerances"
scene = "kepler"
t_end = 1
methods = ["radau_iia_2", "radau_iia_3", "gauss_2"]
tolerances = [1e-3, 1e-4, 1e-5]
[[block]]
name = "steps"
scene = "riccati_tracking"
methods = ["radau_iia_2", "gauss_2"]
steps = [0.1, 0.05, 0.025, 0.0125]
)";

class ReportInBrowser : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (chromium().empty()) return;
    folder_ = std::make_unique<TemporaryFolder>();
    const auto study = folder_->path() / "small.toml", results = folder_->path() / "results";
    std::ofstream(study) << kStudy;
    const auto ran = program({"run", study.string(), "--results", results.string()});
    ASSERT_EQ(ran.err.find("error"), ran.err.npos) << ran.err;
    const auto reported = program({"report", "--results", results.string()});
    ASSERT_EQ(reported.status, 0) << reported.err;
  }
  static void TearDownTestSuite() { folder_.reset(); }
  void SetUp() override { IRK_NEEDS_CHROMIUM(); }

  // Those that there are: without node-d3 there is no explorer.
  static std::vector<std::filesystem::path> pages() {
    std::vector<std::filesystem::path> pages;
    for (const auto* name : {"index.html", "explore.html"}) {
      const auto page = folder_->path() / "results" / "report" / name;
      if (std::filesystem::exists(page)) pages.push_back(page);
    }
    return pages;
  }

  static std::unique_ptr<TemporaryFolder> folder_;
};
std::unique_ptr<TemporaryFolder> ReportInBrowser::folder_;

TEST_F(ReportInBrowser, WritesNoErrorsToTheConsole) {
  ASSERT_FALSE(pages().empty());
  for (const auto& page : pages()) {
    const auto opened = openPage(page);
    EXPECT_EQ(opened.status, 0) << page;
    EXPECT_NE(opened.dom.find("</html>"), opened.dom.npos) << page;
    for (const auto& line : opened.console) ADD_FAILURE() << page << ": " << line;
  }
}

// Chromium must be seen to report what the test above expects not to be there. (It says nothing of missing images.)
TEST_F(ReportInBrowser, SeesErrors) {
  const TemporaryFolder folder;
  const auto page = folder.path() / "bad.html";
  std::ofstream(page) << "<!DOCTYPE html><script>nowhere();</script><script>console.error('aloud');</script>";
  EXPECT_EQ(openPage(page).console.size(), 2u);
}

TEST_F(ReportInBrowser, HasNoBrokenLinks) {
  for (const auto& page : pages()) {
    const auto links = drive(page, "", R"(
      for (const box of page.querySelectorAll("details")) box.open = true;
      return [...page.querySelectorAll("[href], [src]")].map(node => node.getAttribute("href") || node.getAttribute("src"))
        .filter(link => link.startsWith("#")).filter(link => !page.getElementById(decodeURIComponent(link.slice(1))))
        .concat([...page.querySelectorAll("[href], [src]")].map(node => node.getAttribute("href") || node.getAttribute("src"))
        .filter(link => !link.startsWith("#")));)");
    std::set<std::string> seen;
    for (const auto& link : links) {
      const std::string text = link;
      if (!seen.insert(text).second || text.starts_with("https://")) continue;
      EXPECT_FALSE(text.starts_with("#")) << page << ": no part " << text;
      const auto file = page.parent_path() / text.substr(0, text.find_first_of("#?"));
      EXPECT_TRUE(std::filesystem::exists(file)) << page << ": " << text;
    }
    EXPECT_GE(seen.size(), 1u) << page;
  }
}

// Fails unless the numbers of these cells rise; texts are not judged.
void ordered(const std::vector<std::string>& cells) {
  std::vector<double> numbers;
  for (const auto& cell : cells) {
    char* end = nullptr;
    numbers.push_back(std::strtod(cell.c_str(), &end));
    if (end == cell.c_str()) return;
  }
  EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end())) << cells.front() << " … " << cells.back();
}

// Each button in the head of a sortable table puts the rows in an order, and the other way round when it is pressed
// again.
TEST_F(ReportInBrowser, SortsItsTables) {
  const auto tables = drive(pages().front(), "", R"(
    const result = [];
    for (const box of page.querySelectorAll("details")) box.open = true;
    for (const button of page.querySelectorAll("table thead th button")) {
      const table = button.closest("table"), column = button.closest("th").cellIndex;
      const cells = () => [...table.tBodies[0].rows].map(row => row.cells[column].textContent.trim())
        .filter(text => text !== "" && text !== "–");  // missing values may stay last
      const before = cells();
      if (new Set(before).size < 2) continue;
      button.click(); const once = cells();
      button.click(); const twice = cells();
      result.push({ before, once, twice });
    }
    return result;)");
  if (tables.empty()) GTEST_SKIP() << "the page has no table with buttons to sort it";
  for (const auto& table : tables) {
    auto sorted = table["before"].get<std::vector<std::string>>();
    ordered(table["once"]);
    auto once = table["once"].get<std::vector<std::string>>(), twice = table["twice"].get<std::vector<std::string>>();
    EXPECT_NE(once, twice);
    std::reverse(twice.begin(), twice.end());
    EXPECT_EQ(once, twice);
    std::sort(sorted.begin(), sorted.end());
    std::sort(once.begin(), once.end());
    EXPECT_EQ(once, sorted) << "no row is lost";
  }
}

// The page itself never scrolls sideways; wide tables do so in boxes of their own.
TEST_F(ReportInBrowser, FitsAPhone) {
  for (const auto& page : pages()) {
    const auto width = drive(page, "", "return page.documentElement.scrollWidth;", 400);
    EXPECT_LE(width, 400) << page;
  }
}

// Chromium shrinks all pages of a print to the widest thing on them. A4 with margins of 12 mm is 703 px wide.
TEST_F(ReportInBrowser, FitsPaper) {
  constexpr int kPaper = 703;
  const auto width = drive(pages().front(), "", R"(
    for (const box of page.querySelectorAll("details")) box.open = true;
    for (const sheet of page.styleSheets) {
      for (const rule of sheet.cssRules) if (rule.media && rule.media.mediaText === "print") rule.media.mediaText = "all";
    }
    return Math.max(page.documentElement.scrollWidth, ...[...page.querySelectorAll("table")].map(table => table.scrollWidth));)",
                           kPaper);
  EXPECT_LE(width, kPaper);
}

// On a phone a row is a block; cells without a value take no line of it.
TEST_F(ReportInBrowser, LeavesOutMissingValuesOnAPhone) {
  const auto seen = drive(pages().front(), "", R"(
    for (const box of page.querySelectorAll("details")) box.open = true;
    const cells = [...page.querySelectorAll("table.data td")], missing = cells.filter(cell => cell.textContent.trim() === "–");
    return { cells: cells.length, missing: missing.length, seen: missing.filter(cell => cell.offsetHeight > 0).length };)",
                          400);
  ASSERT_GT(seen["missing"], 0);
  EXPECT_GT(seen["cells"], seen["missing"]);
  EXPECT_EQ(seen["seen"], 0);
}

}  // namespace
}  // namespace irk
