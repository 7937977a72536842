#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "experiments/base/time_left.h"
#include "experiments/report/report.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/builtin_studies.h"
#include "experiments/study/study_reader.h"
#include "irk/scene.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/report/drawn.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

std::filesystem::path plots() { return std::filesystem::path(IRK_SOURCE_DIR) / "plots"; }

TEST(Figures, BelongToStudiesAndScriptsThatExist) {
  std::set<std::string> studies{"tableaus"}, names;
  for (const auto& study : builtinStudies()) studies.emplace(study.id);
  for (const auto& figure : readFigures(plots() / "figures.txt")) {
    EXPECT_TRUE(studies.contains(figure.study)) << figure.name << ": " << figure.study;
    EXPECT_TRUE(std::filesystem::exists(plots() / figure.script)) << figure.name;
    EXPECT_TRUE(names.insert(figure.name).second) << figure.name << " twice";
    EXPECT_FALSE(figure.title.empty() || figure.caption.empty()) << figure.name;
  }
}

// The study shows a solution of every scene of the library, each in a figure, except the foreign ones of the audit: no
// study of the paper runs these.
TEST(Figures, ShowEveryScene) {
  std::set<std::string> solved, shown;
  for (const auto& series : loadStudy("scenes", StudyVariant::kFull).series) solved.insert(series.runs[0].scene);
  for (const auto& figure : readFigures(plots() / "figures.txt")) {
    if (figure.study != "scenes") continue;
    const std::string start = "scene='";
    const auto from = figure.assignments.find(start) + start.size();
    shown.insert(figure.assignments.substr(from, figure.assignments.find('\'', from) - from));
  }
  for (const SceneEntry& entry : sceneCatalogue()) {
    if (entry.registered) continue;  // by another test
    if (entry.collections == std::vector<std::string>{"foreign"}) {
      EXPECT_FALSE(solved.contains(entry.id)) << entry.id;
      continue;
    }
    EXPECT_TRUE(solved.contains(entry.id)) << entry.id;
    EXPECT_TRUE(shown.contains(entry.id)) << entry.id;
  }
}

// Titles and captions are read on the page, where nobody sets formulas: 10⁻², not 10^{-2} or 1e-2.
TEST(Figures, HaveNoRawNotation) {
  const std::regex raw("\\^|[{}]|[0-9]e[-+]?[0-9]");
  for (const auto& figure : readFigures(plots() / "figures.txt")) {
    EXPECT_FALSE(std::regex_search(figure.title + " " + figure.caption, raw)) << figure.name << ": " << figure.caption;
  }
}

TEST(Figures, FailureMapsShowDigitsAndCauses) {
  Drawing drawing;
  drawing.put("runs.csv", R"(scene,settings,method,family,stages,h,rtol,outcome,error
pendulum,,radau_iia_2,radau_iia,2,0.1,1e-6,success,1e-3
pendulum,,radau_iia_2,radau_iia,2,0.01,1e-6,success,0
pendulum,,radau_iia_3,radau_iia,3,0.1,1e-6,newton_failed,nan
pendulum,,radau_iia_3,radau_iia,3,0.01,1e-6,timeout,nan
)");
  const Svg svg = drawing.draw("failure_map.gp", "scene='pendulum'");
  EXPECT_TRUE(says(svg, {"Radau IIA", "Newton fails", "too slow", "correct digits"}));
  EXPECT_EQ(svg.occurrences("singular"), 0) << "only causes that occur";
}

TEST(Figures, RobustnessShowsTheCollectionsAndSolversOfTheTable) {
  Drawing drawing;
  drawing.put("robustness.csv", R"(collection,integrator,tolerance,runs,right,failed,wrong,unjudged
all,variable,all,10,7,2,1,0
all,variable,1e-4,10,7,2,1,0
ivp,variable,all,10,7,2,1,0
ivp,variable,1e-4,10,7,2,1,0
)");
  const Svg svg = drawing.draw("robustness.gp", "");
  EXPECT_TRUE(says(svg, {"ivp", "variable", "honest failure", "tolerance"}));
  EXPECT_EQ(svg.occurrences("multibody"), 0) << "only collections with runs";
}

TEST(Estimates, OfSmallStepsAreTheTrueErrors) {
  const auto [study, runs] = runsOf(R"(
estimates = true
[[block]]
scene = "riccati_tracking"
methods = "radau_iia_2"
tolerances = 1e-6
)");
  const Table table = estimateTable(study, runs);
  ASSERT_GT(table.rows.size(), 5u);
  for (const auto& row : table.rows) {
    EXPECT_EQ(textAt(table, row, "group"), "x");
    // |V_h - V_{h/2}| / (2^p - 1) is the error of V_{h/2} up to O(h).
    EXPECT_NEAR(numberAt(table, row, "doubling"), 1, 0.2);
    EXPECT_EQ(numberAt(table, row, "doubling"), numberAt(table, row, "richardson")) << "p = q";
  }
}

TEST(TimeLeft, CountsEveryKindByItsOwnLength) {
  TimeLeft time;
  time.expect("short", 10);
  time.expect("long", 2);
  time.expect("unknown", 1);
  EXPECT_EQ(time.left(), 0) << "nothing is known yet";
  time.made("short", 1);
  time.made("long", 100);
  // 9 short ones, 1 long one, and one of the mean length.
  EXPECT_NEAR(time.left(), 9 * 1 + 100 + 50.5, 1e-12);
  time.dropped("long", 1);
  EXPECT_NEAR(time.left(), 9 * 1 + 50.5, 1e-12);
  EXPECT_EQ(time.spent(), 101);
}

}  // namespace
}  // namespace irk
