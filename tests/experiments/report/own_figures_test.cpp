// Figures of studies that are not built in: those that a file asks for, and those by default.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <set>

#include "experiments/report/default_figures.h"
#include "experiments/report/own_figures.h"
#include "experiments/report/report.h"
#include "experiments/report/scripts.h"
#include "experiments/study/builtin_studies.h"
#include "experiments/study/study_reader.h"
#include "tests/experiments/report/drawn.h"

namespace irk {
namespace {

class OwnFigures : public testing::Test {
 protected:
  std::string file(const std::string& text) const {
    const std::string path = folder_.path() / "mine.toml";
    std::ofstream(path) << text;
    return path;
  }
  FigureTables figures(const std::string& text) const {
    const auto path = file(text);
    return figuresOfStudy(loadStudy(path, StudyVariant::kFull), path);
  }
  std::string misuse(const std::string& figure) const {
    return misuseOf([&] { (void)figures(kBlock + "[[figure]]\n" + figure); });
  }
  static constexpr const char* kLines =
      "[[block]]\nname = \"a\"\nscene = \"kepler\"\nmethods = \"gauss_2\"\ntolerances = [1e-3, 1e-4]\n";
  const std::string kBlock = kLines;  // lines 1 to 5

  TemporaryFolder folder_;
};

// The options of a script are those that it tests for.
TEST_F(OwnFigures, ScriptsSayWhatTheyTake) {
  const Script script = readScript(IRK_SOURCE_DIR, "work_by");
  const std::set<std::string> options(script.options.begin(), script.options.end());
  EXPECT_EQ(options, (std::set<std::string>{"at_end", "variant", "variants", "cases", "titles", "costs", "quantity",
                                            "only", "columns"}));
  EXPECT_EQ(script.tables, std::vector<std::string>{"runs.csv"});
  // Every built-in figure has legal options only.
  for (const auto& figure : readFigures(std::filesystem::path(IRK_SOURCE_DIR) / "plots" / "figures.txt")) {
    const auto path = std::filesystem::path(figure.script).replace_extension();
    const auto known = readScript(IRK_SOURCE_DIR, path).options;
    for (const std::string name : {"scene", "block", "settings", "cases", "only", "columns", "families", "parameter"}) {
      const bool given = ("; " + figure.assignments).find("; " + name + "=") != std::string::npos;
      EXPECT_TRUE(!given || std::find(known.begin(), known.end(), name) != known.end()) << figure.name << ": " << name;
    }
  }
}

TEST_F(OwnFigures, MistakesNameLineAndNearestName) {
  EXPECT_TRUE(containsAll(misuse("script = \"work_precison\"\n"), {"mine.toml:6", "'work_precision'"}));
  const std::string start = "script = \"work_by\"\n";
  EXPECT_TRUE(containsAll(misuse(start + "varian = \"newton\"\n"), {"mine.toml:8", "'variant'"}));
  EXPECT_TRUE(containsAll(misuse(start + "variant = \"newtn\"\n"), {"mine.toml:8", "'newtn'", "'newton'"}));
  EXPECT_TRUE(containsAll(misuse(start + "costs = [\"cpu_s\", \"jacobian_s\"]\n"), {"mine.toml:8", "'jacobian_s'"}));
  EXPECT_TRUE(containsAll(misuse(start + "only = \"metod=gauss_2\"\n"), {"mine.toml:8", "'metod'", "'method'"}));
  EXPECT_TRUE(containsAll(misuse(start + "only = \"gauss_2\"\n"), {"mine.toml:8", "column=value"}));
  EXPECT_TRUE(containsAll(misuse(start + "cases = \"block=b:kepler\"\n"), {"mine.toml:8", "block 'b'", "'a'"}));
  EXPECT_TRUE(containsAll(misuse("script = \"order_vs_stages\"\n"), {"mine.toml:6", "orders.csv", "'orders'"}));
  EXPECT_TRUE(containsAll(misuse("script = \"audit\"\n"), {"mine.toml:6", "[audit]"}));
  EXPECT_TRUE(containsAll(misuse("script = \"stability\"\n"), {"mine.toml:6", "irk tableau"}));
}

std::vector<std::string> scripts(const FigureTables& tables) {
  std::vector<std::string> names;
  for (const auto& figure : tables.figures) names.push_back(figure.script);
  return names;
}

std::string optionsOf(const FigureTables& tables, std::size_t i) { return assignmentsOf(tables.figures.at(i).options); }

TEST_F(OwnFigures, ByDefaultShowWhatVaries) {
  // Tolerances: one curve per method, one panel per scene, one figure for each of what else varies.
  auto tables = figures(R"([[block]]
name = "a"
scene = ["pendulum", "slider_crank"]
formulation = ["index2", "ggl"]
methods = ["gauss_2", "radau_iia_2", "cvode_bdf"]
tolerances = [1e-3, 1e-4]
)");
  EXPECT_EQ(scripts(tables), (std::vector<std::string>{"work_by", "work_by"}));
  EXPECT_TRUE(containsAll(optionsOf(tables, 0), {"variant='method'", "cases='block=a:pendulum block=a:slider_crank'",
                                                 "only='formulation=index2'", "costs='residuals'"}));
  EXPECT_TRUE(containsAll(optionsOf(tables, 1), {"only='formulation=ggl'"}));
  EXPECT_EQ(tables.figures[1].name, "work_by_2");

  // One method: the curves are what varies. Times are measured. A configuration decides several settings.
  tables = figures("[timing]\n" + kBlock + "newton = [\"simplified\", \"broyden\"]\n");
  EXPECT_TRUE(containsAll(optionsOf(tables, 0), {"variant='newton'", "costs='cpu_s'"}));
  tables = figures(kBlock + "configuration = [\"default\", \"paper\", \"embedded\"]\n");
  ASSERT_EQ(tables.figures.size(), 1u);
  EXPECT_TRUE(containsAll(optionsOf(tables, 0), {"variant='integrator'"}));

  // Steps: the error, and the orders with their components.
  tables = figures(
      "orders = true\n[[block]]\nscene = \"pendulum\"\nfamilies = \"gauss\"\nstages = [2, 3]\n"
      "refine_most = 8\nformulation = [\"index2\", \"index3\"]\nmultipliers = \"stages\"\n");
  EXPECT_EQ(scripts(tables),
            (std::vector<std::string>{"error_vs_step", "error_vs_step", "order_vs_stages", "order_vs_stages"}));
  EXPECT_TRUE(containsAll(optionsOf(tables, 0), {"component='u'", "families='gauss'", "only='formulation=index2'"}));
  EXPECT_TRUE(containsAll(optionsOf(tables, 3), {"components='u v z'", "formulation='index3'"}));
  tables = figures(
      "[[block]]\nscene = \"kepler\"\nmethods = [\"gauss_2\", \"gauss_3\"]\nsteps = [0.1, 0.05]\n"
      "configuration = [\"default\", \"paper\"]\n");
  EXPECT_EQ(scripts(tables), (std::vector<std::string>{"error_vs_step", "error_vs_step"}));
  EXPECT_TRUE(containsAll(optionsOf(tables, 1), {"only='configuration=paper'"}));
}

TEST_F(OwnFigures, ByDefaultDrawSolutionsThatAreKept) {
  const auto tables = figures("trajectories = true\n" + kBlock);
  EXPECT_EQ(scripts(tables), (std::vector<std::string>{"work_by", "scene_solution"}));
  EXPECT_TRUE(containsAll(optionsOf(tables, 1), {"scene='kepler'", "file_name='kepler.gauss_2'"}));
}

// What is chosen by default would also be accepted from a file.
TEST_F(OwnFigures, TheDefaultOnesAreLegal) {
  for (const auto& study : builtinStudies()) {
    if (study.id == "audit") continue;
    for (const auto& figure : defaultFigures(loadStudy(study.id, StudyVariant::kQuick))) {
      EXPECT_NO_THROW(checkFigure(figure, IRK_SOURCE_DIR, {})) << study.id << ": " << figure.name;
    }
  }
}

TEST_F(OwnFigures, ABuiltInStudyKeepsNone) {
  EXPECT_TRUE(figuresOfStudy(loadStudy("drift", StudyVariant::kFull), "drift").figures.empty());
  std::filesystem::create_directories(folder_.path() / "drift");
  std::ofstream(folder_.path() / "drift" / kFiguresFile) << "title = \"x\"\n";
  EXPECT_TRUE(ownStudies(folder_.path()).empty());
}

// Two own tableaus of one family and number of stages, and a built-in method of another family.
std::vector<Cells> twoOfAFamily() {
  std::vector<Cells> rows;
  const auto add = [&](const std::string& method, const char* family, double factor) {
    for (int i = 1; i <= 3; ++i) {
      rows.push_back(run(i, {{"scene", "kepler"},
                             {"method", method},
                             {"family", family},
                             {"stages", "2"},
                             {"h", exact(std::pow(0.1, i))},
                             {"error", exact(factor * std::pow(0.1, i))},
                             {"error_x", exact(factor * std::pow(0.1, i))},
                             {"residuals", exact(std::pow(10, i))}}));
    }
  };
  add("a b/one.txt", "sdirk", 1);
  add("two.txt", "sdirk", 0.1);
  add("gauss_2", "gauss", 0.01);
  return rows;
}

TEST(OwnTableaus, OfOneFamilyAreTwoCurves) {
  Drawing drawing;
  drawing.put("runs.csv", kRunColumns, twoOfAFamily());
  const auto points = [](double factor) {
    std::vector<SvgPoint> all;
    for (int i = 1; i <= 3; ++i) all.push_back({factor * std::pow(0.1, i), std::pow(10, i)});
    return all;
  };
  const Svg work = drawing.draw("work_precision.gp", "family='sdirk'; costs='residuals'");
  expectPoints(work.marks('a', 1, kLog, kLog), points(1), "one");
  expectPoints(work.marks('a', 2, kLog, kLog), points(0.1), "two");
  EXPECT_TRUE(says(work, {"2 one", "2 two"}));
  const Svg by = drawing.draw("work_by.gp", "variant='method'; costs='residuals'");
  ASSERT_GE(by.marked('a').size(), 3u);
  EXPECT_TRUE(says(by, {">one<", ">two<", "gauss_2"}));
  // Another column than the stages.
  const Svg variant =
      drawing.draw("work_precision.gp", "variant='method'; only='method=two.txt'; costs='residuals'; scene='kepler'");
  expectPoints(variant.marks('a', 1, kLog, kLog), points(0.1), "only two");
}

TEST(OwnTableaus, OfOneFamilyAreTwoPanels) {
  Drawing drawing;
  drawing.put("runs.csv", kRunColumns, twoOfAFamily());
  const Svg map = drawing.draw("failure_map.gp", "scene='kepler'");
  EXPECT_TRUE(says(map, {"one", "two", "Gauss"}));
  std::vector<Cells> orders;
  const auto add = [&](const char* method, const char* family, const char* order) {
    orders.push_back({{"scene", "kepler"},
                      {"settings", ""},
                      {"method", method},
                      {"family", family},
                      {"stages", "2"},
                      {"component", "x"},
                      {"power_of", "h"},
                      {"order", order},
                      {"theory", order},
                      {"confidence", "0.01"},
                      {"h_min", "0.001"},
                      {"h_max", "0.1"},
                      {"verdict", "agrees"}});
  };
  add("a b/one.txt", "sdirk", "2");
  add("two.txt", "sdirk", "3");
  add("gauss_2", "gauss", "4");
  drawing.put("orders.csv",
              {"scene", "settings", "formulation", "method", "family", "stages", "component", "power_of", "order",
               "theory", "confidence", "h_min", "h_max", "verdict"},
              orders);
  const Svg svg = drawing.draw("order_vs_stages.gp", "scene='kepler'; components='x'");
  EXPECT_TRUE(says(svg, {"one", "two", "Gauss"}));
  const auto height = [&](char panel) { return svg.marks(panel, 2, kLin, kLin).at(0).y; };
  EXPECT_NEAR(height('a'), 4, 0.05);
  EXPECT_NEAR(height('b'), 2, 0.05);
  EXPECT_NEAR(height('c'), 3, 0.05);
  const Svg steps = drawing.draw("error_vs_step.gp", "scene='kepler'; families='sdirk'");
  EXPECT_TRUE(says(steps, {"2 one: 2.00", "2 two: 3.00"}));
}

// One damaged file costs the figures of its study only.
TEST_F(OwnFigures, DamagedOnesDoNotStopTheOthers) {
  const ReportOptions options{folder_.path() / "results", IRK_SOURCE_DIR};
  for (const char* study : {"broken", "whole"}) std::filesystem::create_directories(options.results / study);
  keepFigures(figures(kBlock), options.results / "whole");
  std::ofstream(options.results / "broken" / kFiguresFile) << "[[figure]]\nscript = 3\n";
  const auto broken = brokenFigures(options);
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_TRUE(containsAll(broken.at("broken"), {"broken/figures.toml"}));
  EXPECT_EQ(ownTitle(options.results, "broken"), "broken");
  std::set<std::string> drawn;
  for (const auto& figure : allFigures(options)) drawn.insert(figure.study);
  EXPECT_TRUE(drawn.contains("whole"));
  EXPECT_FALSE(drawn.contains("broken"));
  EXPECT_TRUE(containsAll(misuseOf([&] { drawFigures("broken", options, std::cerr); }), {"broken/figures.toml"}));
}

}  // namespace
}  // namespace irk
