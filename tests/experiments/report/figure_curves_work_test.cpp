#include <fmt/format.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "experiments/tables/table.h"
#include "tests/experiments/report/drawn.h"
#include "tests/experiments/support.h"
#include "tests/experiments/svg.h"

namespace irk {
namespace {

std::vector<SvgPoint> runPoints(const std::string& x, const std::string& y, int from, int to) {
  std::vector<SvgPoint> points;
  for (int i = from; i < to; ++i) points.push_back({numberOf(x, i), numberOf(y, i)});
  return points;
}

TEST(FigureCurves, WorkPrecision) {
  Drawing drawing;
  std::vector<Cells> rows;
  for (int s : {3, 5}) {
    for (int i = 0; i < 4; ++i) {
      rows.push_back(run(i + s, {{"scene", "pendulum"}, {"family", "radau_iia"}, {"stages", std::to_string(s)}}));
    }
  }
  rows.push_back(run(
      1, {{"scene", "pendulum"}, {"family", "radau_iia"}, {"stages", "3"}, {"outcome", "timeout"}, {"rtol", "1e-4"}}));
  rows.push_back(run(9, {{"scene", "kepler"}, {"family", "radau_iia"}, {"stages", "3"}}));
  rows.push_back(run(9, {{"scene", "pendulum"}, {"family", "gauss"}, {"stages", "3"}}));
  rows.push_back(run(9, {{"scene", "pendulum"}, {"settings", "k=1"}, {"family", "radau_iia"}, {"stages", "3"}}));
  drawing.put("runs.csv", kRunColumns, rows);
  for (const std::string quantity : {"error", "error_u", "error_v", "error_z", "error_x"}) {
    for (const std::string cost : {"cpu_s", "residuals"}) {
      const Svg svg =
          drawing.draw("work_precision.gp",
                       fmt::format("scene='pendulum'; family='radau_iia'; quantity='{}'; costs='{}'", quantity, cost));
      expectPoints(svg.marks('a', 1, kLog, kLog), runPoints(quantity, cost, 3, 7), quantity + cost);
      expectPoints(svg.marks('a', 2, kLog, kLog), runPoints(quantity, cost, 5, 9), quantity + cost);
      const auto failed = svg.marks('a', 3, kLog, kLog);
      ASSERT_EQ(failed.size(), 1u);
      EXPECT_NEAR(failed[0].x, 1e-4, 1e-6) << "at the tolerance asked for";
      EXPECT_GT(failed[0].y, numberOf(cost, 8)) << "above all lines";
    }
  }
  const Svg several =
      drawing.draw("work_precision.gp", "scene='pendulum'; costs='jacobians newton_iterations factorizations'");
  expectPoints(several.marks('a', 1, kLog, kLog), runPoints("error", "jacobians", 3, 7), "a");
  expectPoints(several.marks('b', 1, kLog, kLog), runPoints("error", "newton_iterations", 3, 7), "b");
  expectPoints(several.marks('c', 1, kLog, kLog), runPoints("error", "factorizations", 3, 7), "c");
}

// A method that is more accurate than the reference must not be missing: what is known is the bound.
TEST(FigureCurves, WorkDrawsErrorsBelowTheReferencesAccuracyAtTheBound) {
  auto columns = kRunColumns;
  columns.push_back("reference_accuracy");
  for (const std::string script : {"work_precision.gp", "work_by.gp"}) {
    Drawing drawing;
    std::vector<Cells> rows;
    for (const char* error : {"1e-4", "nan"}) {
      rows.push_back(
          run(static_cast<int>(rows.size()) + 1,
              {{"scene", "e5"}, {"method", "gauss_3"}, {"family", "gauss"}, {"stages", "3"}, {"error", error}}));
      rows.back()["reference_accuracy"] = "1e-10";
    }
    drawing.put("runs.csv", columns, rows);
    for (const std::string quantity : {"error", "error_z"}) {
      const Svg svg = drawing.draw(
          script, fmt::format("{}; quantity='{}'",
                              script == "work_by.gp" ? "variant='method'; cases='e5'" : "scene='e5'; family='gauss'",
                              quantity));
      const auto marks = svg.marks('a', 1, kLog, kLog);
      ASSERT_EQ(marks.size(), 2u) << script;
      EXPECT_EQ(std::abs(std::log10(marks[1].x) + 9) < 0.1, quantity == "error") << script << ' ' << marks[1].x;
    }
  }
}

// E5 reports errors of 1e-188 once its components have all but vanished; without a least error nothing else is legible.
TEST(FigureCurves, WorkDrawsNoErrorBelowRoundOffOfDouble) {
  for (const auto& [scalar, least] : {std::pair("double", 1e-17), std::pair("mp50", 1e-64)}) {
    Drawing drawing;
    std::vector<Cells> rows;
    for (const char* error : {"1e-4", "1e-8", "1e-64"}) {
      rows.push_back(
          run(static_cast<int>(rows.size()) + 1,
              {{"scene", "e5"}, {"family", "gauss"}, {"stages", "3"}, {"error", error}, {"scalar", scalar}}));
    }
    drawing.put("runs.csv", kRunColumns, rows);
    const Svg svg = drawing.draw("work_precision.gp", "scene='e5'; family='gauss'");
    auto marks = svg.marks('a', 1, kLog, kLog);
    ASSERT_EQ(marks.size(), 3u);
    EXPECT_NEAR(std::log10(marks[0].x), -4, 0.1);
    EXPECT_NEAR(std::log10(marks[1].x), -8, 0.1);
    EXPECT_NEAR(std::log10(marks[2].x), std::log10(least), 0.5) << scalar;
  }
}

TEST(FigureCurves, WorkBy) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* scene, const char* newton, const char* formulation, int from) {
    for (int i = from; i < from + 3; ++i) {
      rows.push_back(run(i, {{"scene", scene}, {"newton", newton}, {"formulation", formulation}}));
    }
  };
  add("pendulum", "simplified", "index2", 1);
  add("pendulum", "modified", "index2", 2);
  add("pendulum", "full", "index2", 3);
  add("pendulum", "modified", "ggl", 5);  // excluded by `only`
  add("kepler", "simplified", "index2", 4);
  add("kepler", "modified", "index2", 6);
  drawing.put("runs.csv", kRunColumns, rows);
  const Svg svg = drawing.draw("work_by.gp",
                               "variant='newton'; variants='modified simplified'; cases='pendulum kepler'; "
                               "only='formulation=index2'; costs='residuals'");
  expectPoints(svg.marks('a', 1, kLog, kLog), runPoints("error", "residuals", 2, 5), "modified");
  expectPoints(svg.marks('a', 2, kLog, kLog), runPoints("error", "residuals", 1, 4), "simplified");
  expectPoints(svg.marks('b', 1, kLog, kLog), runPoints("error", "residuals", 6, 9), "kepler, modified");
  expectPoints(svg.marks('b', 2, kLog, kLog), runPoints("error", "residuals", 4, 7), "kepler, simplified");
  const Svg costs = drawing.draw("work_by.gp",
                                 "variant='newton'; variants='full'; cases='pendulum'; quantity='error_v'; "
                                 "costs='cpu_s newton_iterations drift'");
  expectPoints(costs.marks('a', 1, kLog, kLog), runPoints("error_v", "cpu_s", 3, 6), "cpu_s");
  expectPoints(costs.marks('b', 1, kLog, kLog), runPoints("error_v", "newton_iterations", 3, 6), "iterations");
  expectPoints(costs.marks('c', 1, kLog, kLog), runPoints("error_v", "drift", 3, 6), "drift");
}

// A failed run stands at its tolerance; with fixed steps, which have none, left of all errors.
TEST(FigureCurves, WorkByPlacesFailures) {
  auto columns = kRunColumns;
  columns.emplace_back("control");
  for (const char* control : {"predictive", "fixed"}) {
    Drawing drawing;
    std::vector<Cells> rows;
    const Cells common = {{"scene", "pendulum"}, {"newton", "full"}, {"control", control}, {"rtol", "1e-30"}};
    for (int i = 1; i < 4; ++i) rows.push_back(run(i, common));
    Cells failure = common;
    failure["outcome"] = "newton_failed";
    failure["rtol"] = "1e-4";
    rows.push_back(run(4, failure));
    drawing.put("runs.csv", columns, rows);
    const Svg svg = drawing.draw("work_by.gp", "variant='newton'; cases='pendulum'; costs='residuals'");
    const auto failed = svg.marks('a', 2, kLog, kLog);
    ASSERT_EQ(failed.size(), 1u) << control;
    const auto errors = svg.marks('a', 1, kLog, kLog);
    double largest = 0;
    for (const auto& at : errors) largest = std::max(largest, at.x);
    if (control == std::string("fixed")) {
      EXPECT_GT(failed[0].x, 1.3 * largest);
    } else {
      EXPECT_NEAR(failed[0].x, 1e-4, 2e-6);
    }
  }
}

// Runs that differ in either of two columns are not joined by one line.
TEST(FigureCurves, WorkByCombinationsOfColumns) {
  Drawing drawing;
  std::vector<Cells> rows;
  int from = 1;
  for (const char* newton : {"full", "simplified"}) {
    for (const char* formulation : {"ggl", "index2"}) {
      for (int i = from; i < from + 3; ++i) {
        rows.push_back(run(i, {{"scene", "pendulum"}, {"newton", newton}, {"formulation", formulation}}));
      }
      from += 2;
    }
  }
  drawing.put("runs.csv", kRunColumns, rows);
  const Svg svg =
      drawing.draw("work_by.gp",
                   "variant='newton formulation'; variants='full:ggl full:index2 simplified:ggl simplified:index2'; "
                   "cases='pendulum'; costs='residuals'");
  for (int curve = 1; curve <= 4; ++curve) {
    expectPoints(svg.marks('a', curve, kLog, kLog), runPoints("error", "residuals", 2 * curve - 1, 2 * curve + 2),
                 std::to_string(curve));
  }
}

TEST(FigureCurves, WorkByExplainsOnlyWhatIsDrawn) {
  Drawing drawing;
  std::vector<Cells> rows;
  for (int i = 1; i < 4; ++i) rows.push_back(run(i, {{"scene", "pendulum"}, {"newton", "simplified"}, {"rtol", "1"}}));
  drawing.put("runs.csv", kRunColumns, rows);
  const std::string options = "variant='newton'; variants='modified simplified'; cases='pendulum'";
  const Svg svg = drawing.draw("work_by.gp", options);
  EXPECT_EQ(svg.occurrences("<text>modified</text>"), 0) << "no run of it";
  EXPECT_EQ(svg.occurrences("<text>simplified</text>"), 1);
  EXPECT_EQ(svg.occurrences("<text>failed</text>"), 0);
  EXPECT_EQ(svg.occurrences("error above 1000 tolerances</text>"), 0);
}

// The bar of the audit, 1000 tolerances + 1e-9, for errors of u, v and x; with a fixed step there is no tolerance.
TEST(FigureCurves, WorkMarksWrongSuccesses) {
  Drawing drawing;
  auto columns = kRunColumns;
  columns.insert(columns.end(), {"control", "reference_accuracy"});
  std::vector<Cells> rows;
  const auto add = [&](int i, const Cells& judged) {
    Cells cells{{"scene", "pendulum"}, {"family", "radau_iia"}, {"stages", "3"},      {"newton", "simplified"},
                {"rtol", "1e-8"},      {"atol", "0"},           {"control", "paper"}, {"error_u", "1e-6"},
                {"error_v", "1e-6"},   {"error_x", "nan"},      {"error_z", "1"}};
    for (const auto& [column, text] : judged) cells[column] = text;
    rows.push_back(run(i, cells));
  };
  add(1, {});
  add(2, {{"error_v", "1.1e-5"}});
  add(3, {{"error_u", "0.99e-5"}});
  add(4, {{"error_x", "1.1e-5"}, {"atol", "1e-7"}});
  add(5, {{"error_u", "1.1e-5"}, {"control", "fixed"}});
  add(6, {{"error_u", "1.1e-5"}, {"reference_accuracy", "1e-5"}});  // too vague to judge
  add(7, {{"error_u", "1.1e-5"}, {"outcome", "drift"}});
  drawing.put("runs.csv", columns, rows);
  for (const auto* options : {"variant='newton'; cases='pendulum'", "scene='pendulum'; family='radau_iia'"}) {
    const bool by = std::string(options).starts_with("variant");
    const Svg svg = drawing.draw(by ? "work_by.gp" : "work_precision.gp", options);
    EXPECT_EQ(svg.occurrences("error above 1000 tolerances</text>"), 1) << options;
    expectPoints(svg.marks('a', 3, kLog, kLog), {{numberOf("error", 2), numberOf("cpu_s", 2)}}, options);
  }
}

// The largest error at the reference times is drawn where the table has it, else that at the end.
TEST(FigureCurves, WorkOverTime) {
  Drawing drawing;
  auto columns = kRunColumns;
  columns.insert(columns.end(), {"reference_times", "error_over_time", "error_u_over_time"});
  std::vector<Cells> rows;
  for (int i = 1; i < 4; ++i) {
    rows.push_back(run(i, {{"scene", "pendulum"},
                           {"family", "radau_iia"},
                           {"stages", "3"},
                           {"newton", "simplified"},
                           {"reference_times", "10"},
                           {"error_over_time", exact(3 * numberOf("error", i))},
                           {"error_u_over_time", exact(5 * numberOf("error_u", i))}}));
  }
  rows.back()["error_over_time"] = "nan";
  drawing.put("runs.csv", columns, rows);
  for (const std::string script : {"work_by.gp", "work_precision.gp"}) {
    const std::string one = script == "work_by.gp" ? "variant='newton'; cases='pendulum'" : "scene='pendulum'";
    const Svg svg = drawing.draw(script, one);
    expectPoints(svg.marks('a', 1, kLog, kLog),
                 {{3 * numberOf("error", 1), numberOf("cpu_s", 1)},
                  {3 * numberOf("error", 2), numberOf("cpu_s", 2)},
                  {numberOf("error", 3), numberOf("cpu_s", 3)}},
                 script);
    EXPECT_EQ(svg.occurrences("error, largest at 10 times"), 1) << script;
    const Svg positions = drawing.draw(script, one + "; quantity='error_u'");
    EXPECT_NEAR(positions.marks('a', 1, kLog, kLog).front().x, 5 * numberOf("error_u", 1), 1e-3);
    const Svg end = drawing.draw(script, one + "; at_end=1");
    expectPoints(end.marks('a', 1, kLog, kLog), runPoints("error", "cpu_s", 1, 4), script + ", at the end");
    EXPECT_EQ(end.occurrences("largest at"), 0) << script;
  }
}

TEST(FigureCurves, BestCost) {
  Drawing drawing;
  const std::string table = R"(scene,settings,family,stages,target_error,reached,cpu_s,residuals
pendulum,,radau_iia,2,1e-4,1,0.01,7e5
pendulum,,radau_iia,3,1e-4,1,0.05,1.4e5
pendulum,,radau_iia,2,1e-6,1,0.8,8750
pendulum,,radau_iia,3,1e-6,1,0.1,7e4
pendulum,,gauss,2,1e-4,1,0.3,2e4
pendulum,,gauss,2,1e-6,1,9,800
kepler,,gauss,2,1e-4,1,0.02,3.5e5
kepler,,gauss,2,1e-6,1,7,1000
)";
  drawing.put("cpu_at_error.csv", table);
  const Svg svg = drawing.draw("best_cost.gp", "cases='pendulum kepler'");
  expectPoints(svg.marks('a', 1, kLog, kLog), {{1e-6, 0.1}, {1e-4, 0.01}}, "radau");
  expectPoints(svg.marks('a', 2, kLog, kLog), {{1e-6, 9}, {1e-4, 0.3}}, "gauss");
  expectPoints(svg.marks('b', 1, kLog, kLog), {{1e-6, 7}, {1e-4, 0.02}}, "kepler, its only family");
  EXPECT_EQ(svg.occurrences("no run reaches"), 0);
  const Svg other = drawing.draw("best_cost.gp", "cases='pendulum'; cost='residuals'; values='gauss'");
  expectPoints(other.marks('a', 1, kLog, kLog), {{1e-6, 800}, {1e-4, 2e4}}, "residuals");
  drawing.put("cpu_at_error.csv", table + "robertson,,gauss,2,1e-4,0,nan,nan\n");
  const Svg empty = drawing.draw("best_cost.gp", "cases='pendulum robertson'");
  EXPECT_EQ(empty.occurrences("no run reaches"), 1) << "an empty panel says why";
}

TEST(FigureCurves, CpuVsStages) {
  Drawing drawing;
  drawing.put("cpu_at_error.csv", R"(scene,settings,family,method,stages,target_error,reached,cpu_s,residuals
slider_crank,,radau_iia,nan,2,1e-4,nan,0.01,900
slider_crank,,radau_iia,nan,3,1e-4,nan,0.02,500
slider_crank,,radau_iia,nan,5,1e-4,nan,0.05,100
slider_crank,,radau_iia,nan,2,1e-8,nan,nan,nan
slider_crank,,radau_iia,nan,3,1e-8,nan,3,7000
slider_crank,,radau_iia,nan,5,1e-8,nan,0.7,2000
slider_crank,off=1,radau_iia,nan,2,1e-4,nan,0.4,40
slider_crank,off=1,radau_iia,nan,10,1e-4,nan,0.9,60
)");
  const Svg svg = drawing.draw("cpu_vs_stages.gp", "cases='slider_crank slider_crank:off=1'");
  expectPoints(svg.marks('a', 1, kLog, kLog), {{2, 0.01}, {3, 0.02}, {5, 0.05}}, "1e-4");
  expectPoints(svg.marks('a', 2, kLog, kLog), {{3, 3}, {5, 0.7}}, "1e-8");
  expectPoints(svg.marks('b', 1, kLog, kLog), {{2, 0.4}, {10, 0.9}}, "off=1");
  const Svg residuals = drawing.draw("cpu_vs_stages.gp", "cases='slider_crank'; cost='residuals'");
  expectPoints(residuals.marks('a', 1, kLog, kLog), {{2, 900}, {3, 500}, {5, 100}}, "residuals");
  // Errors that are not reached are drawn above everything else.
  bool missed = false;
  for (const auto& [number, curve] : svg.panel('a').curves) {
    for (const auto& p : svg.numbers('a', curve.marks, kLog, kLog))
      missed = missed || (p.y > 3.01 && std::abs(p.x - 2) < 0.02);
  }
  EXPECT_TRUE(missed);
}

TEST(FigureCurves, Energy) {
  Drawing drawing;
  drawing.put("energy.csv", R"(scene,method,summation,t,h,steps,energy_error,scatter
kepler,gauss_8,plain,1,77,5,2e-16,3e-16
kepler,gauss_8,plain,2,77,5,9e-16,3e-16
kepler,gauss_8,plain,4,77,5,5e-16,3e-16
kepler,gauss_8,compensated,1,77,5,1e-16,3e-16
kepler,gauss_8,compensated,2,77,5,0.5e-16,3e-16
kepler,gauss_8,compensated,4,77,5,1.5e-16,3e-16
)");
  const Svg svg = drawing.draw("energy.gp", "cases='kepler:gauss_8'");
  expectPoints(svg.line('a', 1, kLin, kLin), {{1, 2}, {2, 9}, {4, 5}}, "plain");
  expectPoints(svg.line('a', 2, kLin, kLin), {{1, 1}, {2, 0.5}, {4, 1.5}}, "compensated", 2e-2);
}

}  // namespace
}  // namespace irk
