#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "experiments/analyses/orders/order_fit.h"
#include "experiments/report/html_tables.h"
#include "experiments/report/report.h"
#include "experiments/tables/table.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

// The values of an attribute of the page's elements.
std::vector<std::string> values(const std::string& page, const std::string& attribute) {
  const std::regex expression(" " + attribute + "=\"([^\"]*)\"");
  std::vector<std::string> found;
  for (std::sregex_iterator i(page.begin(), page.end(), expression), end; i != end; ++i) found.push_back((*i)[1]);
  return found;
}

// Every link leads to a file that exists or to an element of the page.
void expectLinks(const std::string& page, const std::filesystem::path& folder) {
  const auto ids = values(page, "id");
  const std::set<std::string> known(ids.begin(), ids.end());
  EXPECT_EQ(known.size(), ids.size()) << "an id is there twice";
  for (const auto* attribute : {"href", "src"}) {
    for (const auto& target : values(page, attribute)) {
      if (target.starts_with("#")) {
        EXPECT_TRUE(known.contains(target.substr(1))) << target;
      } else {
        EXPECT_TRUE(std::filesystem::exists(folder / target)) << target;
      }
    }
  }
}

// Results of two studies with made-up tables, and one figure of each.
class ReportPage : public testing::Test {
 protected:
  explicit ReportPage(const char* name = "results") : results_(folder_.path() / name) {
    const TableHead head{{"study", "made_up"}};
    writeTable(results_ / "order" / "orders.csv",
               {head,
                {"scene",  "settings",  "formulation", "multipliers", "scalar",     "method", "family",
                 "stages", "component", "power_of",    "order",       "confidence", "h_min",  "h_max",
                 "points", "theory",    "source",      "verdict",     "reason",     "block"},
                {{"riccati_tracking",
                  "",
                  "index2",
                  "stages",
                  "mp50",
                  "gauss_2",
                  "gauss",
                  "2",
                  "x",
                  "h",
                  "4.01",
                  "0.01",
                  "0.01",
                  "0.1",
                  "5",
                  "4",
                  "theorem",
                  "agrees",
                  "",
                  "nonlinear"}}});
    writeTable(results_ / "scenes" / "runs.csv",
               {head,
                {"method", "configuration", "control", "outcome", "environment", "cpu_environment"},
                {{"gauss_2", "default", "predictive", "success", "e1", "e1"}}});
    writeTable(results_ / "scenes" / "environments.csv",
               {head,
                {"environment", "cpu", "cores", "memory_gb", "libraries"},
                {{"e1", "A processor", "4", "7.5", "An OS; Eigen 3"}, {"e2", "Not used", "1", "1", ""}}});
    std::ofstream(results_ / "scenes" / "kepler.gauss_8.csv") << "t,q1\n0,1\n";
    std::filesystem::create_directories(results_ / "report" / "figures");
    for (const auto* figure : {"order_ode", "scene_kepler"}) {
      std::ofstream(results_ / "report" / "figures" / (std::string(figure) + ".png")) << "";
      std::ofstream(results_ / "report" / "figures" / (std::string(figure) + ".svg"))
          << "<?xml version=\"1.0\"?>\n<svg\n width=\"" << (figure[0] == 'o' ? 1080 : 640) << "\" height=\"400\">";
    }
  }
  std::string page() const { return readInputFile(writeReport({results_, IRK_SOURCE_DIR})); }

  TemporaryFolder folder_;
  std::filesystem::path results_;
};

TEST_F(ReportPage, HasNoDeadLink) {
  const std::string html = page();
  expectLinks(html, results_ / "report");
  EXPECT_FALSE(std::regex_search(html, std::regex("@[A-Z_]+@"))) << "a placeholder is left";
}

TEST_F(ReportPage, ShowsFiguresWithTablesCommandAndWidth) {
  const std::string html = page();
  EXPECT_TRUE(containsAll(html, {"<figure id=\"order_ode\" class=\"wide\">", "<figure id=\"scene_kepler\">",
                                 "../order/orders.csv", "../scenes/kepler.gauss_8.csv", "width=\"1080\" height=\"400\"",
                                 "plots/order_vs_stages.gp", "alt=\"Diagram: Observed order of all families\""}));
  EXPECT_EQ(values(html, "src").size(), values(html, "alt").size()) << "every image has a text";
  EXPECT_EQ(html.find("quick=1"), html.npos);
}

// The page states how the fit works.
TEST_F(ReportPage, SaysWhatAnOrderNeeds) {
  const OrderFitOptions options;
  EXPECT_EQ(options.min_points, 3);
  EXPECT_EQ(options.min_span, 2);
  EXPECT_TRUE(
      containsAll(page(), {"at least 3 steps, the largest at least 2 times the smallest", "id=\"order_table\""}));
}

TEST_F(ReportPage, AnswersFirst) {
  const std::string html = page();
  const auto at = [&](const char* id) { return html.find(" id=\"" + std::string(id) + "\""); };
  EXPECT_LT(at("answers"), at("solver"));
  EXPECT_LT(at("solver"), at("orders"));
  EXPECT_LT(at("orders"), at("failures"));
  EXPECT_LT(at("failures"), at("paper"));
  EXPECT_LT(at("paper"), at("claims"));
  EXPECT_LT(at("claims"), at("study_order"));
  EXPECT_TRUE(containsAll(html, {"Not known yet: <code>irk run work_precision</code>",
                                 "1 of 1 measured orders agree with theory", "1 runs, 1 successful"}));
  EXPECT_TRUE(std::filesystem::exists(results_ / "report" / "answers_orders.csv"));
  EXPECT_FALSE(std::filesystem::exists(results_ / "report" / "answers_solver.csv")) << "there is nothing to say";
}

TEST_F(ReportPage, SaysWhereTheClockRateChanged) {
  EXPECT_EQ(page().find("the clock rate"), std::string::npos);
  const auto file = results_ / "scenes" / "runs.csv";
  Table runs = readTable(file);
  runs.head.emplace_back("times drift",
                         "37 % of the calibrations on a took more than 1.1 times the shortest one, up to 1.27; "
                         "20 % of the calibrations on b took more than 1.1 times the shortest one, up to 1.87");
  writeTable(file, runs);
  const std::string html = page();
  const auto at = html.find("the clock rate of this machine changed by a factor of up to 1.87");
  ASSERT_NE(at, html.npos);
  EXPECT_GT(at, html.find("id=\"study_scenes\""));
  EXPECT_EQ(html.find("the clock rate", at + 1), html.npos) << "not in the sections of other studies";
}

TEST_F(ReportPage, SaysOnHowManyCoresTimesWereMeasured) {
  const std::string text = "Cores on which times were measured at once";
  EXPECT_EQ(page().find(text), std::string::npos);
  const auto file = results_ / "scenes" / "runs.csv";
  Table runs = readTable(file);
  runs.head.emplace_back("timing cores", "4 on a, 1 or 2 on b");
  writeTable(file, runs);
  const std::string html = page();
  EXPECT_GT(html.find(text + ": 4 on a, 1 or 2 on b."), html.find("id=\"study_scenes\""));
  EXPECT_NE(html.find(text), std::string::npos);
}

// A question in bold has no second stop; a figure of one named file links that file only.
TEST_F(ReportPage, CaptionsEndOnceAndLinkWhatIsDrawn) {
  for (const auto* file : {"stick_slip.radau_iia_5.csv", "stick_slip_Fs_1_k_100_v0_0_vb_0_x0_0.105.radau_iia_5.csv"}) {
    std::ofstream(results_ / "scenes" / file) << "t,q1\n0,1\n";
  }
  std::filesystem::create_directories(results_ / "discontinuity");
  for (const auto* figure : {"scene_coulomb_decay", "discontinuity_locate"}) {
    std::ofstream(results_ / "report" / "figures" / (std::string(figure) + ".png")) << "";
    std::ofstream(results_ / "report" / "figures" / (std::string(figure) + ".svg")) << "<svg width=\"640\">";
  }
  const std::string html = page();
  const auto of = [&](const char* id) {
    const auto from = html.find("<figure id=\"" + std::string(id) + "\"");
    return from == html.npos ? std::string() : html.substr(from, html.find("</figure>", from) - from);
  };
  EXPECT_TRUE(containsAll(of("scene_coulomb_decay"), {"x0_0.105.radau_iia_5.csv", "<b>Scene: Coulomb decay.</b>"}));
  EXPECT_EQ(of("scene_coulomb_decay").find("stick_slip.radau_iia_5.csv"), std::string::npos);
  EXPECT_TRUE(containsAll(of("discontinuity_locate"), {"<b>Located switches: does high order pay again?</b>"}));
}

TEST_F(ReportPage, NamesEachEnvironmentOnce) {
  const std::string html = page();
  EXPECT_TRUE(containsAll(html, {"A processor", "An OS; Eigen 3", "7.5"}));
  EXPECT_EQ(html.find("Not used"), html.npos);
  // Another study of the same machine adds its name, a study of another machine a column.
  Environments environments;
  const std::set<std::string> used{"a", "b"};
  environments.add("one", {{}, {"environment", "cpu"}, {{"a", "X"}}}, used);
  environments.add("two", {{}, {"environment", "cpu"}, {{"a", "X"}}}, used);
  EXPECT_EQ(environments.table().titles.size(), 2u);
  EXPECT_TRUE(containsAll(htmlOf(environments.table()), {"one, two"}));
  environments.add("three", {{}, {"environment", "cpu", "cores"}, {{"b", "Y", "2"}}}, used);
  EXPECT_EQ(environments.table().titles.size(), 3u);
}

TEST_F(ReportPage, WithoutResultsSaysSo) {
  std::filesystem::remove_all(results_);
  const std::string html = page();
  expectLinks(html, results_ / "report");
  EXPECT_TRUE(containsAll(html, {"No study has been run yet", "No runs yet", "Not known yet"}));
}

class QuickReportPage : public ReportPage {
 protected:
  QuickReportPage() : ReportPage("quick") {}
};

TEST_F(QuickReportPage, SaysSoEverywhere) {
  const std::string html = page();
  EXPECT_TRUE(containsAll(html, {"class=\"banner\"", "<em>Preliminary.</em>", "quick=1; data="}));
  const std::regex captions("<caption>([^<]*)</caption>");
  int tables = 0;
  for (std::sregex_iterator i(html.begin(), html.end(), captions), end; i != end; ++i) {
    const std::string caption = (*i)[1];
    if (caption == "Where the runs were made") continue;
    EXPECT_TRUE(containsAll(caption, {"preliminary"}));
    ++tables;
  }
  EXPECT_GE(tables, 3);
}

TEST_F(QuickReportPage, MarksItsFigures) {
  const auto draw = [&](const std::string& out, const std::string& quick) {
    std::ostringstream err;
    EXPECT_TRUE(drawFigure("order_vs_stages.gp",
                           quick + "data='" + (results_ / "order").string() + "'; out='" + (results_ / out).string() +
                               "'; components='x'; scene='riccati_tracking'",
                           IRK_SOURCE_DIR, err))
        << err.str();
    return readInputFile(results_ / (out + ".svg"));
  };
  const std::string mark = "quick run: no verdict";
  const std::string marked = draw("marked", "quick=1; ");
  ASSERT_NE(marked.find(mark), marked.npos);
  EXPECT_EQ(marked.find(mark), marked.rfind(mark)) << "once, not in every panel";
  EXPECT_EQ(draw("plain", "").find(mark), std::string::npos);
}

}  // namespace
}  // namespace irk
