// Labels of figures: labels of axes do not overlap, bars have numbers, switches have marks. Also the figure of cost
// ratios, whose numbers the script computes itself.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <cmath>

#include "tests/experiments/report/drawn.h"

namespace irk {
namespace {

// The least distance of neighbouring numbers on a panel's horizontal axis, in points; 0 with less than two of them.
double leastDistance(const Svg& svg, char panel) {
  std::vector<double> places;
  for (const auto& label : svg.panel(panel).x) {
    if (!std::isnan(labelNumber(label.text))) places.push_back(label.pixel);
  }
  std::sort(places.begin(), places.end());
  double least = places.size() < 2 ? 0 : 1e300;
  for (std::size_t i = 1; i < places.size(); ++i) least = std::min(least, places[i] - places[i - 1]);
  return least;
}

TEST(FigureLabels, OfErrorsStayApartInNarrowPanels) {
  Drawing drawing;
  std::vector<Cells> rows;
  const std::string scenes[] = {"kepler", "pendulum", "hires", "robertson"};
  for (const auto& scene : scenes) {
    for (int i = 0; i < 9; ++i) {
      rows.push_back(run(i, {{"scene", scene}, {"newton", "full"}, {"error", exact(std::pow(10, -2 * i))}}));
    }
  }
  drawing.put("runs.csv", kRunColumns, rows);
  for (int columns = 1; columns <= 4; ++columns) {
    const Svg svg = drawing.draw(
        "work_by.gp", fmt::format("variant='newton'; cases='kepler pendulum hires robertson'; columns={}", columns));
    for (char panel = 'a'; panel <= 'd'; ++panel) EXPECT_GT(leastDistance(svg, panel), 40) << columns << panel;
    EXPECT_NEAR(svg.marks('d', 1, kLog, kLog).back().x, 1e-16, 1e-17) << columns;
  }
}

TEST(FigureLabels, OfTimesStayApartInThreePanels) {
  Drawing drawing;
  for (const double end : {1.0, 0.45, 0.3}) {
    drawing.put(
        fmt::format("until_{}.radau_iia_2.csv", end), {"t", "h"},
        {{{"t", "0.0002"}, {"h", "0.0002"}}, {{"t", exact(end / 2)}, {"h", "0.1"}}, {{"t", exact(end)}, {"h", "0.2"}}});
  }
  const Svg svg = drawing.draw("step_size.gp", "cases='until_1 until_0.45 until_0.3'; methods='radau_iia_2'");
  for (char panel = 'a'; panel <= 'c'; ++panel) {
    EXPECT_GT(leastDistance(svg, panel), 35) << panel;
    for (const auto& label : svg.panel(panel).x) EXPECT_LE(label.text.size(), 6u) << label.text;
  }
}

// An axis with a single number cannot be read.
TEST(FigureLabels, OfAlmostEqualCostsAreSeveral) {
  Drawing drawing;
  std::vector<Cells> rows;
  for (int i = 1; i < 4; ++i) {
    rows.push_back(run(i, {{"scene", "pendulum"}, {"newton", "full"}, {"residuals", exact(1200 + i)}}));
  }
  drawing.put("runs.csv", kRunColumns, rows);
  const Svg svg = drawing.draw("work_by.gp", "variant='newton'; cases='pendulum'; costs='residuals'");
  int numbers = 0;
  for (const auto& label : svg.panel('a').y) numbers += !std::isnan(labelNumber(label.text));
  EXPECT_GE(numbers, 2);
}

// Quick studies leave some of a figure's cases out; empty axes would look like a failure.
TEST(FigureLabels, NameAPanelWithoutRuns) {
  Drawing drawing;
  std::vector<Cells> rows;
  for (int i = 1; i < 4; ++i) rows.push_back(run(i, {{"scene", "pendulum"}, {"newton", "full"}}));
  drawing.put("runs.csv", kRunColumns, rows);
  for (const auto& [cases, empty] : {std::pair{"pendulum kepler", 1}, {"pendulum pendulum", 0}}) {
    const Svg svg = drawing.draw("work_by.gp", fmt::format("variant='newton'; cases='{}'; costs='residuals'", cases));
    EXPECT_EQ(svg.occurrences("no runs in this table"), empty) << cases;
    EXPECT_EQ(svg.marks('a', 1, kLog, kLog).size(), 3u) << cases;
  }
  rows.push_back(run(4, {{"scene", "kepler"}, {"newton", "full"}, {"error", "nan"}}));
  drawing.put("runs.csv", kRunColumns, rows);
  const Svg svg = drawing.draw("work_by.gp", "variant='newton'; cases='pendulum kepler'; costs='residuals'");
  EXPECT_EQ(svg.occurrences("no runs in this table"), 0);
  EXPECT_EQ(svg.occurrences("no run with a known error"), 1);
}

TEST(FigureLabels, SayThatNoRunHasAnError) {
  Drawing drawing;
  const std::vector<Cells> rows = {
      run(1, {{"scene", "pendulum"}, {"newton", "full"}, {"outcome", "refused"}, {"error", "nan"}})};
  drawing.put("runs.csv", kRunColumns, rows);
  const Svg svg = drawing.draw("work_by.gp", "variant='newton'; cases='pendulum'; costs='residuals'");
  EXPECT_EQ(svg.occurrences("no run with a known error"), 1);
}

// Curve 1 is the line of the first choice.
TEST(FigureCurves, CostRatio) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* scene, const char* control, const char* error, const char* cost) {
    rows.push_back({{"scene", scene},
                    {"settings", ""},
                    {"control", control},
                    {"estimate", "doubling"},
                    {"target_error", error},
                    {"cpu_s", cost},
                    {"residuals", exact(100 * std::sqrt(std::atof(cost)))}});
  };
  const std::vector<std::string> columns = {"scene",        "settings", "control",  "estimate",
                                            "target_error", "cpu_s",    "residuals"};
  for (const char* error : {"1e-4", "1e-6"}) add("kepler", "paper", error, "0.04");
  add("kepler", "hotint", "1e-4", "0.01");
  add("kepler", "hotint", "1e-6", "0.08");
  add("kepler", "predictive", "1e-4", "0.06");
  add("kepler", "predictive", "1e-6", "nan");
  add("pendulum", "paper", "1e-4", "2");
  add("pendulum", "hotint", "1e-4", "3");
  rows.push_back(rows.front());
  rows.back()["estimate"] = "richardson";  // excluded by `only`
  rows.back()["cpu_s"] = "77";
  drawing.put("cpu_at_error.csv", columns, rows);
  const std::string options = "variant='control'; only='estimate=doubling'; ";
  const Svg svg = drawing.draw("cost_ratio.gp", options + "cases='kepler pendulum'");
  expectPoints(svg.marks('a', 2, kLog, kLog), {{1e-6, 2}, {1e-4, 0.25}}, "hotint over paper", 0.02);
  expectPoints(svg.marks('a', 3, kLog, kLog), {{1e-4, 1.5}}, "predictive over paper", 0.02);
  const auto lost = svg.marks('a', 5, kLog, kLog);
  ASSERT_EQ(lost.size(), 1u) << "the error that paper reaches and predictive does not";
  EXPECT_NEAR(lost[0].x, 1e-6, 1e-7);
  EXPECT_GT(lost[0].y, 2);
  EXPECT_EQ(svg.occurrences("<text>not reached</text>"), 1);
  const Svg other =
      drawing.draw("cost_ratio.gp", options + "cases='kepler'; costs='cpu_s residuals'; variants='hotint paper'");
  expectPoints(other.marks('a', 2, kLog, kLog), {{1e-6, 0.5}, {1e-4, 4}}, "paper over hotint", 0.02);
  expectPoints(other.marks('b', 2, kLog, kLog), {{1e-6, std::sqrt(0.5)}, {1e-4, 2}}, "in residuals", 0.02);
  EXPECT_EQ(other.occurrences("not reached"), 0);
}

TEST(FigureLabels, RobustnessCountsTheRunsOfABar) {
  Drawing drawing;
  const auto row = [](const char* integrator, const char* runs, const char* right, const char* wrong) {
    return Cells{{"collection", "ivp"}, {"integrator", integrator}, {"tolerance", "1e-4"},
                 {"runs", runs},        {"right", right},           {"failed", "0"},
                 {"wrong", wrong},      {"unjudged", "0"}};
  };
  drawing.put("robustness.csv",
              {"collection", "integrator", "tolerance", "runs", "right", "failed", "wrong", "unjudged"},
              {row("variable", "17", "13", "4"), row("gsl_bsimp", "1", "0", "1")});
  const Svg svg = drawing.draw("robustness.gp", "");
  EXPECT_EQ(svg.occurrences(">17</tspan>"), 1) << "the runs of a bar of variable";
  EXPECT_EQ(svg.occurrences(">4</tspan>"), 1) << "its wrong successes";
  EXPECT_EQ(svg.occurrences(">1</tspan>"), 2) << "runs and wrong successes of gsl_bsimp";
  EXPECT_GE(svg.occurrences("fill=\"rgb(255,255,255)\""), 1) << "white on a bar that is red";
}

TEST(FigureLabels, ManySwitchesAreMarkedByShortLines) {
  Drawing drawing;
  const auto put = [&](int switches) {
    std::vector<Cells> rows;
    for (int i = 0; i <= switches; ++i) {
      rows.push_back({{"t", exact(0.1 * i)}, {"h", "0.1"}, {"u", exact(i)}, {"switches", i == 0 ? "" : "contact"}});
    }
    drawing.put("arm.radau_iia_5.csv", {"t", "h", "u", "switches"}, rows);
    return drawing.draw("scene_solution.gp", "scene='arm'");
  };
  const Svg few = put(6), many = put(30);
  EXPECT_EQ(few.occurrences("dashed lines: contact"), 1);
  EXPECT_EQ(many.occurrences("dashed lines"), 0);
  EXPECT_EQ(many.occurrences("short lines: contact"), 1);
}

// One panel per scene; a table with other settings has none, and a constant is a line.
TEST(FigureLabels, TheGalleryHasAPanelPerScene) {
  Drawing drawing;
  const auto put = [&](const std::string& name, const std::string& scene) {
    std::vector<Cells> rows;
    for (int i = 0; i < 5; ++i) rows.push_back({{"t", exact(i)}, {"u", exact(i * i)}, {"w", "3"}});
    drawing.put(name + ".radau_iia_5.csv", {"t", "u", "w"}, rows, "nan",
                {{"study", "trajectory of " + scene}, {"panels", "\"position in m|u w|1\" \"speed|w|1\""}});
  };
  put("arm", "arm");
  put("arm_k_100", "arm");
  put("beam", "beam");
  const Svg svg = drawing.draw("scenes/scene_gallery.gp", "log_values='arm'");
  for (const char* name : {">arm<", ">beam<"}) EXPECT_EQ(svg.occurrences(name), 1) << name;
  EXPECT_EQ(svg.occurrences("arm_k_100"), 0);
  EXPECT_EQ(svg.occurrences("<g id=\"gnuplot_plot_2"), 2) << "two curves in each panel";
}

// irk run --peers: the user's solver is drawn where the figure names curves of other libraries, and only there.
TEST(FigureLabels, WorkByShowsSolversThatWereGiven) {
  Drawing drawing;
  auto columns = kRunColumns;
  columns.emplace_back("integrator");
  std::vector<Cells> rows;
  for (const auto* solver : {"variable", "cvode_bdf", "my_radau", "paper:radau_iia_5"}) {
    for (int i = 1; i < 4; ++i) rows.push_back(run(i, {{"scene", "pendulum"}, {"integrator", solver}, {"rtol", "1"}}));
  }
  drawing.put("runs.csv", columns, rows);
  const std::string options = "variant='integrator'; cases='pendulum'; variants=";
  const Svg with = drawing.draw("work_by.gp", options + "'variable cvode_bdf'");
  EXPECT_EQ(with.occurrences("<text>my_radau</text>"), 1);
  EXPECT_EQ(with.occurrences("<text>cvode_bdf</text>"), 1);
  EXPECT_EQ(with.occurrences("radau_iia_5"), 0) << "not named";
  EXPECT_EQ(drawing.draw("work_by.gp", options + "'variable paper:radau_iia_5'").occurrences("<text>my_radau"), 0);
}

}  // namespace
}  // namespace irk
