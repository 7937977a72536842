#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "experiments/base/time_left.h"
#include "experiments/report/report.h"
#include "experiments/runner/runner.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/builtin_studies.h"
#include "experiments/study/study_reader.h"
#include "irk/scene.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/study_runs.h"
#include "tests/experiments/support.h"

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
  const TemporaryFolder folder;
  Table runs;
  runs.columns = {"scene", "settings", "method", "family", "stages", "h", "rtol", "outcome", "error"};
  const auto add = [&](const char* stages, const char* h, const char* outcome, const char* error) {
    runs.rows.push_back(
        {"pendulum", "", std::string("radau_iia_") + stages, "radau_iia", stages, h, "1e-6", outcome, error});
  };
  add("2", "0.1", "success", "1e-3");
  add("2", "0.01", "success", "0");
  add("3", "0.1", "newton_failed", "nan");
  add("3", "0.01", "timeout", "nan");
  writeTable(folder.path() / "runs.csv", runs);
  const auto out = folder.path() / "map";
  std::ostringstream err;
  ASSERT_TRUE(drawFigure("failure_map.gp",
                         "data='" + folder.path().string() + "'; out='" + out.string() + "'; scene='pendulum'",
                         IRK_SOURCE_DIR, err))
      << err.str();
  const std::string svg = readInputFile(out.string() + ".svg");
  EXPECT_TRUE(containsAll(svg, {"Radau IIA", "Newton fails", "too slow", "correct digits"}));
  EXPECT_EQ(svg.find("singular"), svg.npos) << "only causes that occur";
  EXPECT_TRUE(std::filesystem::exists(out.string() + ".png"));
}

TEST(Figures, RobustnessShowsTheCollectionsAndSolversOfTheTable) {
  const TemporaryFolder folder;
  Table counts{{}, {"collection", "integrator", "tolerance", "runs", "right", "failed", "wrong", "unjudged"}, {}};
  for (const char* collection : {"all", "ivp"}) {
    for (const char* tolerance : {"all", "1e-4"}) {
      counts.rows.push_back({collection, "variable", tolerance, "10", "7", "2", "1", "0"});
    }
  }
  writeTable(folder.path() / "robustness.csv", counts);
  const auto out = folder.path() / "robustness";
  std::ostringstream err;
  ASSERT_TRUE(drawFigure("robustness.gp", "data='" + folder.path().string() + "'; out='" + out.string() + "'",
                         IRK_SOURCE_DIR, err))
      << err.str();
  const std::string svg = readInputFile(out.string() + ".svg");
  EXPECT_TRUE(containsAll(svg, {"ivp", "variable", "honest failure", "tolerance"}));
  EXPECT_EQ(svg.find("multibody"), svg.npos) << "only collections with runs";
}

TEST(Estimates, OfSmallStepsAreTheTrueErrors) {
  const Study study = parseStudy(R"(
estimates = true
[[block]]
scene = "riccati_tracking"
methods = "radau_iia_2"
tolerances = 1e-6
)",
                                 "small.toml", StudyVariant::kFull);
  const TemporaryFolder folder;
  RunnerOptions options;
  options.results = folder.path();
  std::ostringstream quiet;
  const Table table = estimateTable(study, runStudy(study, options, quiet));
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
