// Every gnuplot script draws a made-up table, in which no two columns are alike, and its curves are
// read back.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "experiments/report/report.h"
#include "experiments/tables/table.h"
#include "tests/experiments/support.h"
#include "tests/experiments/svg.h"

namespace irk {
namespace {

constexpr Axis kLog = Axis::kLogarithmic, kLin = Axis::kLinear;

using Cells = std::map<std::string, std::string>;

std::string exact(double x) { return fmt::format("{}", x); }

/// A folder with tables, and the figures that are drawn from it.
class Drawing {
 public:
  /// Rows by column; what a row does not give is `other`.
  void put(const std::string& name, const std::vector<std::string>& columns,
           const std::vector<Cells>& rows, const std::string& other = "nan") {
    Table table{{{"study", "made_up"}}, columns, {}};
    for (const auto& cells : rows) {
      TableRow row;
      for (const auto& column : columns) {
        const auto given = cells.find(column);
        row.push_back(given == cells.end() ? other : given->second);
      }
      table.rows.push_back(row);
    }
    writeTable(folder_.path() / name, table);
  }

  Svg draw(const std::string& script, const std::string& options) {
    const auto out = folder_.path() / fmt::format("figure_{}", ++count_);
    std::ostringstream err;
    EXPECT_TRUE(drawFigure(
        script,
        fmt::format("data='{}'; out='{}'; {}", folder_.path().string(), out.string(), options),
        IRK_SOURCE_DIR, err))
        << err.str();
    EXPECT_EQ(err.str(), "") << script;
    EXPECT_TRUE(std::filesystem::exists(out.string() + ".png")) << script;
    return Svg(out.string() + ".svg");
  }

 private:
  TemporaryFolder folder_;
  int count_ = 0;
};

const std::vector<std::string> kRunColumns = {"key",
                                              "scene",
                                              "settings",
                                              "method",
                                              "family",
                                              "stages",
                                              "integrator",
                                              "formulation",
                                              "scaling",
                                              "discontinuity",
                                              "scalar",
                                              "newton",
                                              "h",
                                              "rtol",
                                              "atol",
                                              "outcome",
                                              "error",
                                              "error_u",
                                              "error_v",
                                              "error_x",
                                              "error_z",
                                              "drift",
                                              "residuals",
                                              "dual_residuals",
                                              "jacobians",
                                              "factorizations",
                                              "solves",
                                              "newton_iterations",
                                              "newton_restarts",
                                              "steps_accepted",
                                              "steps_rejected_error",
                                              "cpu_s",
                                              "cpu_median_s",
                                              "cpu_spread",
                                              "detail"};

// Of run i: in every column another number, that falls or grows in another way with i.
double numberOf(const std::string& column, int i) {
  const auto place =
      std::find(kRunColumns.begin(), kRunColumns.end(), column) - kRunColumns.begin();
  const double j = static_cast<double>(place);
  const double slope =
      column.starts_with("error") || column == "drift" ? -0.8 - 0.03 * j : 0.1 + 0.02 * j;
  const double level = column.starts_with("error") || column == "drift" ? 1e-2 : 1;
  return level * (1 + 0.13 * j) * std::pow(10, slope * i);
}

Cells run(int i, const Cells& cells) {
  Cells row = cells;
  for (const auto& column :
       {"error", "error_u", "error_v", "error_x", "error_z", "drift", "residuals", "dual_residuals",
        "jacobians", "factorizations", "solves", "newton_iterations", "newton_restarts",
        "steps_accepted", "steps_rejected_error", "cpu_s", "cpu_median_s", "cpu_spread"}) {
    row.try_emplace(column, exact(numberOf(column, i)));
  }
  row.try_emplace("outcome", "success");
  row.try_emplace("settings", "");
  row.try_emplace("rtol", exact(1e-3 * std::pow(0.1, i)));
  row.try_emplace("atol", exact(3e-3 * std::pow(0.1, i)));
  return row;
}

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
      rows.push_back(run(
          i + s, {{"scene", "pendulum"}, {"family", "radau_iia"}, {"stages", std::to_string(s)}}));
    }
  }
  rows.push_back(run(1, {{"scene", "pendulum"},
                         {"family", "radau_iia"},
                         {"stages", "3"},
                         {"outcome", "timeout"},
                         {"rtol", "1e-4"}}));
  rows.push_back(run(9, {{"scene", "kepler"}, {"family", "radau_iia"}, {"stages", "3"}}));
  rows.push_back(run(9, {{"scene", "pendulum"}, {"family", "gauss"}, {"stages", "3"}}));
  rows.push_back(run(
      9, {{"scene", "pendulum"}, {"settings", "k=1"}, {"family", "radau_iia"}, {"stages", "3"}}));
  drawing.put("runs.csv", kRunColumns, rows);
  for (const std::string quantity : {"error", "error_u", "error_v", "error_z", "error_x"}) {
    for (const std::string cost : {"cpu_s", "residuals"}) {
      const Svg svg = drawing.draw(
          "work_precision.gp",
          fmt::format("scene='pendulum'; family='radau_iia'; quantity='{}'; costs='{}'", quantity,
                      cost));
      expectPoints(svg.marks('a', 1, kLog, kLog), runPoints(quantity, cost, 3, 7), quantity + cost);
      expectPoints(svg.marks('a', 2, kLog, kLog), runPoints(quantity, cost, 5, 9), quantity + cost);
      const auto failed = svg.marks('a', 3, kLog, kLog);
      ASSERT_EQ(failed.size(), 1u);
      EXPECT_NEAR(failed[0].x, 1e-4, 1e-6) << "at the tolerance asked for";
      EXPECT_GT(failed[0].y, numberOf(cost, 8)) << "above all lines";
    }
  }
  const Svg several = drawing.draw(
      "work_precision.gp", "scene='pendulum'; costs='jacobians newton_iterations factorizations'");
  expectPoints(several.marks('a', 1, kLog, kLog), runPoints("error", "jacobians", 3, 7), "a");
  expectPoints(several.marks('b', 1, kLog, kLog), runPoints("error", "newton_iterations", 3, 7),
               "b");
  expectPoints(several.marks('c', 1, kLog, kLog), runPoints("error", "factorizations", 3, 7), "c");
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
  add("pendulum", "modified", "ggl", 5);  // not of `only`
  add("kepler", "simplified", "index2", 4);
  add("kepler", "modified", "index2", 6);
  drawing.put("runs.csv", kRunColumns, rows);
  const Svg svg =
      drawing.draw("work_by.gp",
                   "variant='newton'; variants='modified simplified'; cases='pendulum kepler'; "
                   "only='formulation=index2'; costs='residuals'");
  expectPoints(svg.marks('a', 1, kLog, kLog), runPoints("error", "residuals", 2, 5), "modified");
  expectPoints(svg.marks('a', 2, kLog, kLog), runPoints("error", "residuals", 1, 4), "simplified");
  expectPoints(svg.marks('b', 1, kLog, kLog), runPoints("error", "residuals", 6, 9),
               "kepler, modified");
  expectPoints(svg.marks('b', 2, kLog, kLog), runPoints("error", "residuals", 4, 7),
               "kepler, simplified");
  const Svg costs =
      drawing.draw("work_by.gp",
                   "variant='newton'; variants='full'; cases='pendulum'; quantity='error_v'; "
                   "costs='cpu_s newton_iterations drift'");
  expectPoints(costs.marks('a', 1, kLog, kLog), runPoints("error_v", "cpu_s", 3, 6), "cpu_s");
  expectPoints(costs.marks('b', 1, kLog, kLog), runPoints("error_v", "newton_iterations", 3, 6),
               "iterations");
  expectPoints(costs.marks('c', 1, kLog, kLog), runPoints("error_v", "drift", 3, 6), "drift");
}

const std::vector<std::string> kCostColumns = {"scene",     "settings",         "family",  "method",
                                               "stages",    "target_error",     "reached", "cpu_s",
                                               "residuals", "newton_iterations"};

TEST(FigureCurves, BestCost) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* scene, const char* family, int s, const char* error,
                       double cost) {
    rows.push_back({{"scene", scene},
                    {"settings", ""},
                    {"family", family},
                    {"stages", std::to_string(s)},
                    {"target_error", error},
                    {"reached", "1"},
                    {"cpu_s", exact(cost)},
                    {"residuals", exact(7000 / cost)}});
  };
  add("pendulum", "radau_iia", 2, "1e-4", 0.01);
  add("pendulum", "radau_iia", 3, "1e-4", 0.05);
  add("pendulum", "radau_iia", 2, "1e-6", 0.8);
  add("pendulum", "radau_iia", 3, "1e-6", 0.1);
  add("pendulum", "gauss", 2, "1e-4", 0.3);
  add("pendulum", "gauss", 2, "1e-6", 9);
  add("kepler", "gauss", 2, "1e-4", 0.02);
  add("kepler", "gauss", 2, "1e-6", 7);
  drawing.put("cpu_at_error.csv", kCostColumns, rows);
  const Svg svg = drawing.draw("best_cost.gp", "cases='pendulum kepler'");
  expectPoints(svg.marks('a', 1, kLog, kLog), {{1e-6, 0.1}, {1e-4, 0.01}}, "radau");
  expectPoints(svg.marks('a', 2, kLog, kLog), {{1e-6, 9}, {1e-4, 0.3}}, "gauss");
  expectPoints(svg.marks('b', 2, kLog, kLog), {{1e-6, 7}, {1e-4, 0.02}}, "kepler");
  const Svg other =
      drawing.draw("best_cost.gp", "cases='pendulum'; cost='residuals'; values='gauss'");
  expectPoints(other.marks('a', 1, kLog, kLog), {{1e-6, 7000 / 9.0}, {1e-4, 7000 / 0.3}},
               "residuals");
}

TEST(FigureCurves, CpuVsStages) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* settings, int s, const char* error, const char* cost,
                       const char* residuals) {
    rows.push_back({{"scene", "slider_crank"},
                    {"settings", settings},
                    {"family", "radau_iia"},
                    {"stages", std::to_string(s)},
                    {"target_error", error},
                    {"cpu_s", cost},
                    {"residuals", residuals}});
  };
  add("", 2, "1e-4", "0.01", "900");
  add("", 3, "1e-4", "0.02", "500");
  add("", 5, "1e-4", "0.05", "100");
  add("", 2, "1e-8", "nan", "nan");
  add("", 3, "1e-8", "3", "7000");
  add("", 5, "1e-8", "0.7", "2000");
  add("off=1", 2, "1e-4", "0.4", "40");
  add("off=1", 10, "1e-4", "0.9", "60");
  drawing.put("cpu_at_error.csv", kCostColumns, rows);
  const Svg svg = drawing.draw("cpu_vs_stages.gp", "cases='slider_crank slider_crank:off=1'");
  expectPoints(svg.marks('a', 1, kLog, kLog), {{2, 0.01}, {3, 0.02}, {5, 0.05}}, "1e-4");
  expectPoints(svg.marks('a', 2, kLog, kLog), {{3, 3}, {5, 0.7}}, "1e-8");
  expectPoints(svg.marks('b', 1, kLog, kLog), {{2, 0.4}, {10, 0.9}}, "off=1");
  const Svg residuals = drawing.draw("cpu_vs_stages.gp", "cases='slider_crank'; cost='residuals'");
  expectPoints(residuals.marks('a', 1, kLog, kLog), {{2, 900}, {3, 500}, {5, 100}}, "residuals");
  // What was not reached stands above all.
  bool missed = false;
  for (const auto& [number, curve] : svg.panel('a').curves) {
    for (const auto& p : svg.numbers('a', curve.marks, kLog, kLog))
      missed = missed || (p.y > 3.01 && std::abs(p.x - 2) < 0.02);
  }
  EXPECT_TRUE(missed);
}

TEST(FigureCurves, Energy) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* summation, double t, double error) {
    rows.push_back({{"scene", "kepler"},
                    {"method", "gauss_8"},
                    {"summation", summation},
                    {"t", exact(t)},
                    {"energy_error", exact(error)},
                    {"scatter", "3e-16"},
                    {"h", "77"},
                    {"steps", "5"}});
  };
  add("plain", 1, 2e-16);
  add("plain", 2, 9e-16);
  add("plain", 4, 5e-16);
  add("compensated", 1, 1e-16);
  add("compensated", 2, 0.5e-16);
  add("compensated", 4, 1.5e-16);
  drawing.put("energy.csv",
              {"scene", "method", "summation", "t", "h", "steps", "energy_error", "scatter"}, rows);
  const Svg svg = drawing.draw("energy.gp", "cases='kepler:gauss_8'");
  expectPoints(svg.line('a', 1, kLin, kLin), {{1, 2}, {2, 9}, {4, 5}}, "plain");
  expectPoints(svg.line('a', 2, kLin, kLin), {{1, 1}, {2, 0.5}, {4, 1.5}}, "compensated", 2e-2);
}

TEST(FigureCurves, ErrorVsStep) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* family, int s, int from) {
    for (int i = from; i < from + 3; ++i) {
      rows.push_back(run(i, {{"scene", "riccati_tracking"},
                             {"family", family},
                             {"stages", std::to_string(s)},
                             {"h", exact(std::pow(0.1, i))}}));
    }
  };
  add("radau_iia", 2, 1);
  add("radau_iia", 3, 2);
  add("gauss", 2, 3);
  drawing.put("runs.csv", kRunColumns, rows);
  drawing.put("orders.csv",
              {"scene", "settings", "formulation", "component", "power_of", "family", "stages",
               "order", "theory", "confidence", "h_min", "h_max", "verdict"},
              {{{"scene", "riccati_tracking"},
                {"settings", ""},
                {"component", "x"},
                {"power_of", "h"},
                {"family", "radau_iia"},
                {"stages", "2"},
                {"order", "3.1"},
                {"theory", "3"},
                {"h_min", "0.001"},
                {"h_max", "0.1"},
                {"verdict", "agrees"}}});
  for (const std::string component : {"x", "u"}) {
    const Svg svg = drawing.draw(
        "error_vs_step.gp", fmt::format("families='radau_iia gauss'; component='{}'", component));
    const auto expected = [&](int from) {  // sorted by h
      std::vector<SvgPoint> points;
      for (int i = from + 2; i >= from; --i)
        points.push_back({std::pow(0.1, i), numberOf("error_" + component, i)});
      return points;
    };
    const auto a = svg.marked('a'), b = svg.marked('b');
    ASSERT_EQ(a.size(), 2u);
    ASSERT_EQ(b.size(), 1u);
    expectPoints(svg.marks('a', a[0], kLog, kLog), expected(1), "radau 2");
    expectPoints(svg.marks('a', a[1], kLog, kLog), expected(2), "radau 3");
    expectPoints(svg.marks('b', b[0], kLog, kLog), expected(3), "gauss 2");
    if (component == "x") {  // slope 3 through the middle of the window
      const auto theory = svg.line('a', 1, kLog, kLog);
      ASSERT_EQ(theory.size(), 3u);
      EXPECT_NEAR(std::log(theory[2].y / theory[0].y) / std::log(theory[2].x / theory[0].x), 3,
                  0.03);
      EXPECT_NEAR(theory[0].x, 1e-3, 1e-5);
    }
  }
}

TEST(FigureCurves, EstimateRatio) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* group, double doubling, double richardson) {
    rows.push_back({{"group", group},
                    {"doubling", exact(doubling)},
                    {"richardson", exact(richardson)},
                    {"t", "1"}});
  };
  add("u", 1, 10);
  add("u", 2, 20);
  add("v", 0.5, 0.1);
  add("v", 4, 0.2);
  drawing.put("estimates.csv", {"t", "group", "doubling", "richardson"}, rows);
  const Svg svg = drawing.draw("estimate_ratio.gp", "");
  // Largest first: half of the steps lie above it.
  expectPoints(svg.line('a', 1, kLog, kLog), {{2, 0.5}, {1, 1}}, "doubling u", 2e-2);
  expectPoints(svg.line('a', 2, kLog, kLog), {{4, 0.5}, {0.5, 1}}, "doubling v", 2e-2);
  expectPoints(svg.line('b', 1, kLog, kLog), {{20, 0.5}, {10, 1}}, "richardson u", 2e-2);
  expectPoints(svg.line('b', 2, kLog, kLog), {{0.2, 0.5}, {0.1, 1}}, "richardson v", 2e-2);
}

TEST(FigureCurves, FailureMap) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](int s, const char* h, const char* rtol, const char* outcome,
                       const char* error, const char* error_u) {
    rows.push_back({{"scene", "pendulum"},
                    {"settings", ""},
                    {"family", "radau_iia"},
                    {"stages", std::to_string(s)},
                    {"h", h},
                    {"rtol", rtol},
                    {"outcome", outcome},
                    {"error", error},
                    {"error_u", error_u}});
  };
  add(2, "0.1", "1e-3", "success", "1e-3", "1e-12");
  add(2, "0.01", "1e-4", "success", "1e-12", "1e-3");
  add(3, "0.1", "1e-3", "newton_failed", "nan", "nan");
  add(3, "0.01", "1e-4", "success", "1e-3", "1e-6");
  rows.push_back({{"scene", "pendulum"},  // of two numbers of stages this family has one
                  {"settings", ""},
                  {"family", "lobatto_iiia"},
                  {"stages", "3"},
                  {"h", "0.1"},
                  {"rtol", "1e-3"},
                  {"outcome", "success"},
                  {"error", "1e-6"},
                  {"error_u", "1e-6"}});
  drawing.put("runs.csv",
              {"scene", "settings", "family", "stages", "h", "rtol", "outcome", "error", "error_u"},
              rows);
  const auto cellsOf = [](const Svg& svg) {  // colour by the labels of the cell
    std::map<std::string, std::string> cells;
    for (const auto& [colour, corners] : svg.curve('a', 1).boxes) {
      double x = 0, y = 0;
      for (const auto& c : corners)
        x += c.x / static_cast<double>(corners.size()),
            y += c.y / static_cast<double>(corners.size());
      cells[svg.labelX('a', x) + " " + svg.labelY('a', y)] = colour;
    }
    return cells;
  };
  auto cells = cellsOf(drawing.draw("failure_map.gp", "scene='pendulum'"));
  ASSERT_EQ(cells.size(), 3u);
  ASSERT_TRUE(cells.contains("2 10^-1") && cells.contains("2 10^-2") && cells.contains("3 10^-2"));
  EXPECT_EQ(cells["2 10^-1"], cells["3 10^-2"]) << "three digits";
  EXPECT_NE(cells["2 10^-1"], cells["2 10^-2"]);
  auto of_u =
      cellsOf(drawing.draw("failure_map.gp", "scene='pendulum'; quantity='error_u'; y='rtol'"));
  EXPECT_EQ(of_u["2 10^-3"], cells["2 10^-2"]) << "twelve digits";
  EXPECT_EQ(of_u["2 10^-4"], cells["2 10^-1"]) << "three digits";
  const Svg svg = drawing.draw("failure_map.gp", "scene='pendulum'");
  const auto& failed = svg.curve('a', 2).marks;
  ASSERT_EQ(failed.size(), 1u);
  EXPECT_EQ(svg.labelX('a', failed[0].x), "3");
  EXPECT_EQ(svg.labelY('a', failed[0].y), "10^-1");
  EXPECT_EQ(svg.occurrences("<text>no such method</text>"), 1);
  EXPECT_EQ(svg.occurrences("fill = 'rgb(228, 228, 228)'"), 1) << "the column of the method that there is not";
}

const std::vector<std::string> kOrderColumns = {
    "scene",  "settings", "formulation", "component", "power_of", "family", "stages",
    "theory", "order",    "confidence",  "h_min",     "h_max",    "points", "verdict"};

// Marks with error bars are drawn twice.
std::vector<SvgPoint> once(const std::vector<SvgPoint>& points) {
  std::vector<SvgPoint> different;
  for (const auto& p : points) {
    const auto same = [&](const SvgPoint& q) { return q.x == p.x && q.y == p.y; };
    if (std::none_of(different.begin(), different.end(), same)) different.push_back(p);
  }
  return different;
}

TEST(FigureCurves, OrderVsStages) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* component, int s, double order, double theory,
                       const char* verdict) {
    rows.push_back({{"scene", "kaps"},
                    {"settings", ""},
                    {"component", component},
                    {"power_of", "h"},
                    {"family", "radau_iia"},
                    {"stages", std::to_string(s)},
                    {"order", exact(order)},
                    {"theory", exact(theory)},
                    {"confidence", "0.1"},
                    {"verdict", verdict},
                    {"points", "13"}});
  };
  add("x", 1, 1.2, 1, "agrees");
  add("x", 2, 2.6, 3, "agrees");
  add("x", 4, 5.4, 7, "differs");
  add("z", 2, 9, 9, "agrees");
  drawing.put("orders.csv", kOrderColumns, rows);
  const Svg svg = drawing.draw("order_vs_stages.gp", "scene='kaps'; components='x'");
  expectPoints(svg.line('a', 1, kLin, kLin), {{1, 1}, {2, 3}, {4, 7}}, "theory", 1e-2);
  expectPoints(once(svg.marks('a', 2, kLin, kLin)), {{1, 1.2}, {2, 2.6}, {4, 5.4}}, "measured",
               1e-2);
  expectPoints(svg.marks('a', 3, kLin, kLin), {{4, 5.4}}, "differs", 1e-2);
  const Svg both = drawing.draw("order_vs_stages.gp", "scene='kaps'; components='x z'");
  const auto z = once(both.marks('a', 4, kLin, kLin));
  ASSERT_EQ(z.size(), 1u);
  EXPECT_NEAR(z[0].y, 9, 0.1);
}

TEST(FigureCurves, OrderVsStiffness) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* settings, int s, const char* order, const char* theory = "nan",
                       const char* verdict = "agrees") {
    rows.push_back({{"scene", "prothero_robinson"},
                    {"settings", settings},
                    {"component", "x"},
                    {"power_of", "h"},
                    {"family", "gauss"},
                    {"stages", std::to_string(s)},
                    {"order", order},
                    {"theory", theory},
                    {"confidence", "0.3"},
                    {"verdict", verdict}});
  };
  add("lambda=-1e2", 2, "3.9");
  add("lambda=-1e4", 2, "2.5");
  add("", 2, "2.1", "3");  // -1e8
  add("lambda=-1e2", 3, "5.9");
  add("lambda=-1e4", 3, "nan", "nan", "not_measurable");
  add("", 3, "4.4");
  add("lambda=-1e8/h", 2, "11");  // no single stiffness
  drawing.put("orders.csv", kOrderColumns, rows);
  const Svg svg = drawing.draw("order_vs_stiffness.gp", "scene='prothero_robinson'");
  // Curves of two numbers of stages each: theory's bars, the lines, the triangles.
  expectPoints(svg.line('a', 1, kLog, kLin), {{4e7, 3}, {2.5e8, 3}}, "theory", 2e-2);
  expectPoints(svg.marks('a', 3, kLog, kLin), {{1e2, 3.9}, {1e4, 2.5}, {1e8, 2.1}}, "s = 2", 1e-2);
  expectPoints(svg.marks('a', 4, kLog, kLin), {{1e2, 5.9}, {1e8, 4.4}}, "s = 3", 1e-2);
  EXPECT_EQ(svg.curve('a', 3).pieces, 1);
  EXPECT_EQ(svg.curve('a', 4).pieces, 2) << "a line over what is not measurable";
  const auto lost = svg.marks('a', 6, kLog, kLin);
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_NEAR(std::log10(lost[0].x), 4, 0.2);
  EXPECT_LT(lost[0].y, 2.1) << "below all orders";
}

TEST(FigureCurves, OverStages) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* family, int s, double a, double eigenvectors) {
    rows.push_back({{"family", family},
                    {"stages", std::to_string(s)},
                    {"condition_A", exact(a)},
                    {"condition_eigenvectors", exact(eigenvectors)},
                    {"error_constant", exact(-1e-3 * a)},
                    {"order", "99"}});
  };
  add("gauss", 2, 10, 300);
  add("gauss", 4, 100, 20);
  add("gauss", 6, 700, 5000);
  add("radau_iia", 2, 20, 60);
  add("radau_iia", 4, 5, 900);
  drawing.put(
      "tableaus.csv",
      {"family", "stages", "order", "error_constant", "condition_A", "condition_eigenvectors"},
      rows);
  const Svg svg = drawing.draw("over_stages.gp", "");
  expectPoints(svg.marks('a', 1, kLin, kLog), {{2, 10}, {4, 100}, {6, 700}}, "gauss");
  expectPoints(svg.marks('a', 2, kLin, kLog), {{2, 20}, {4, 5}}, "radau");
  expectPoints(svg.marks('b', 1, kLin, kLog), {{2, 300}, {4, 20}, {6, 5000}},
               "gauss, eigenvectors");
  const Svg constants = drawing.draw("over_stages.gp", "quantities='error_constant'");
  expectPoints(constants.marks('a', 1, kLin, kLog), {{2, 0.01}, {4, 0.1}, {6, 0.7}}, "magnitudes");
}

TEST(FigureCurves, OverStep) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* formulation, const char* scaling, int from,
                       const char* outcome) {
    for (int i = from; i < from + 3; ++i) {
      rows.push_back(run(i, {{"scene", "pendulum"},
                             {"method", "radau_iia_3"},
                             {"formulation", formulation},
                             {"scaling", scaling},
                             {"h", exact(std::pow(0.1, i))},
                             {"outcome", outcome}}));
    }
  };
  add("index3", "on", 1, "success");
  add("index3", "off", 2, "success");
  add("index2", "on", 3, "newton_failed");
  drawing.put("runs.csv", kRunColumns, rows);
  const Svg svg = drawing.draw("over_step.gp", "quantities='error_z error_v iterations'");
  const auto expected = [&](const char* quantity, int from) {
    std::vector<SvgPoint> points;  // smooth unique: by ascending h
    for (int i = from + 2; i >= from; --i) {
      points.push_back(
          {std::pow(0.1, i), quantity == std::string("iterations")
                                 ? numberOf("newton_iterations", i) / numberOf("steps_accepted", i)
                                 : numberOf(quantity, i)});
    }
    return points;
  };
  expectPoints(svg.marks('a', 1, kLog, kLog), expected("error_z", 1), "z, scaled");
  expectPoints(svg.marks('a', 2, kLog, kLog), expected("error_z", 2), "z, unscaled");
  expectPoints(svg.marks('b', 1, kLog, kLog), expected("error_v", 1), "v");
  expectPoints(svg.marks('c', 1, kLog, kLin), expected("iterations", 1), "iterations", 1e-2);
}

TEST(FigureCurves, Profile) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* target, const char* integrator, double ratio, double fraction) {
    rows.push_back({{"target_error", target},
                    {"integrator", integrator},
                    {"ratio", exact(ratio)},
                    {"fraction", exact(fraction)},
                    {"problems", "55"}});
  };
  add("1e-4", "variable", 1, 0.5);
  add("1e-4", "variable", 10, 0.8);
  add("1e-4", "cvode_bdf", 2, 0.2);
  add("1e-4", "cvode_bdf", 50, 0.9);
  add("1e-8", "variable", 3, 0.3);
  add("1e-8", "variable", 30, 0.6);
  drawing.put("profile.csv", {"target_error", "problems", "integrator", "ratio", "fraction"}, rows);
  const Svg svg = drawing.draw("profile.gp", "targets='-4 -8'");
  expectPoints(svg.line('a', 1, kLog, kLin), {{1, 0.5}, {10, 0.5}, {10, 0.8}}, "variable", 2e-2);
  expectPoints(svg.line('a', 2, kLog, kLin), {{2, 0.2}, {50, 0.2}, {50, 0.9}}, "cvode", 2e-2);
  expectPoints(svg.line('b', 1, kLog, kLin), {{3, 0.3}, {30, 0.3}, {30, 0.6}}, "1e-8", 2e-2);
}

TEST(FigureCurves, Scaling) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* method, const char* solver, const char* storage,
                       const char* threads, int n, double step) {
    rows.push_back({{"scene", "beam_chain"},
                    {"method", method},
                    {"solver", solver},
                    {"storage", storage},
                    {"threads", threads},
                    {"n", std::to_string(n)},
                    {"step_s", exact(step)},
                    {"steps", exact(9 / step)}});
  };
  add("radau_iia_3", "schur", "sparse", "1", 10, 1e-5);
  add("radau_iia_3", "schur", "sparse", "1", 100, 2e-4);
  add("radau_iia_3", "schur", "sparse", "1", 1000, 7e-3);
  add("radau_iia_3", "schur", "dense", "1", 10, 3e-5);
  add("radau_iia_3", "schur", "dense", "1", 100, 5e-2);
  add("radau_iia_5", "schur", "sparse", "1", 10, 4e-5);
  add("radau_iia_5", "schur", "sparse", "1", 1000, 6e-3);
  drawing.put("scaling.csv",
              {"scene", "method", "solver", "storage", "threads", "n", "steps", "step_s"}, rows);
  const Svg svg = drawing.draw("scaling.gp", "");
  expectPoints(svg.marks('a', 2, kLog, kLog), {{10, 1e-5}, {100, 2e-4}, {1000, 7e-3}}, "sparse");
  expectPoints(svg.marks('a', 4, kLog, kLog), {{10, 3e-5}, {100, 5e-2}}, "dense");
  expectPoints(svg.marks('b', 2, kLog, kLog), {{10, 4e-5}, {1000, 6e-3}}, "five stages");
}

TEST(FigureCurves, SceneSolution) {
  Drawing drawing;
  std::vector<Cells> rows;
  const double t[] = {0, 1, 3, 4};
  for (int i = 0; i < 4; ++i) {
    const double x = t[i];
    rows.push_back({{"t", exact(x)},
                    {"h", "5"},
                    {"error", "6"},
                    {"newton_iterations", "7"},
                    {"switches", "8"},
                    {"x", exact(1 + x)},
                    {"y", exact(9 - 2 * x)},
                    {"x'", exact(x * x)},
                    {"y'", exact(3 - x)},
                    {"lambda", exact(10 + 5 * x)}});
  }
  drawing.put("pendulum.radau_iia_5.csv",
              {"t", "h", "error", "newton_iterations", "switches", "x", "y", "x'", "y'", "lambda"},
              rows);
  const Svg svg = drawing.draw("scene_solution.gp", "scene='pendulum'");
  const auto near = [&](char panel, int curve, const std::vector<SvgPoint>& expected,
                        const char* what) {
    const auto seen = svg.line(panel, curve, kLin, kLin);
    ASSERT_EQ(seen.size(), expected.size()) << what;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      EXPECT_NEAR(seen[i].x, expected[i].x, 0.02) << what;
      EXPECT_NEAR(seen[i].y, expected[i].y, 0.1) << what;
    }
  };
  near('a', 1, {{0, 1}, {1, 2}, {3, 4}, {4, 5}}, "x");
  near('a', 2, {{0, 9}, {1, 7}, {3, 3}, {4, 1}}, "y");
  near('b', 1, {{0, 0}, {1, 1}, {3, 9}, {4, 16}}, "x'");
  near('b', 2, {{0, 3}, {1, 2}, {3, 0}, {4, -1}}, "y'");
  near('c', 1, {{0, 10}, {1, 15}, {3, 25}, {4, 30}}, "lambda");
  // A scene without a layout: one panel per column, but for those of the steps.
  drawing.put("mine.radau_iia_5.csv", {"t", "h", "error", "newton_iterations", "switches", "p"},
              {{{"t", "0"}, {"h", "9"}, {"p", "1"}}, {{"t", "2"}, {"h", "9"}, {"p", "4"}}});
  const Svg own = drawing.draw("scene_solution.gp", "scene='mine'");
  expectPoints(own.line('a', 1, kLin, kLin), {{0, 1}, {2, 4}}, "p", 2e-2);
  EXPECT_TRUE(own.panel('b').curves.empty());
}

TEST(FigureCurves, Shares) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](int n, const char* solver, double residual, double jacobian,
                       double factorization, double solve) {
    rows.push_back({{"scene", "ancf_pendulum"},
                    {"derivatives", "difference_forward"},
                    {"solver", solver},
                    {"method", "radau_iia_3"},
                    {"n", std::to_string(n)},
                    {"share_residual", exact(residual)},
                    {"share_jacobian", exact(jacobian)},
                    {"share_factorization", exact(factorization)},
                    {"share_solve", exact(solve)},
                    {"factorization_s", "0.77"}});
  };
  add(10, "coupled_dense", 0.4, 0.3, 0.2, 0.1);
  add(50, "coupled_dense", 0.05, 0.15, 0.75, 0.05);
  add(10, "schur", 0.1, 0.2, 0.3, 0.4);
  drawing.put("phases.csv",
              {"scene", "derivatives", "solver", "method", "n", "factorization_s", "share_residual",
               "share_jacobian", "share_factorization", "share_solve", "share_update", "share_step",
               "share_start"},
              rows, "0");
  const Svg svg = drawing.draw("shares.gp", "methods='radau_iia_3'");
  const auto heights = [&](char panel, int part) {
    std::map<std::string, std::pair<double, double>>
        by_size;  // bottom and top, by the last row's labels
    for (const auto& [colour, corners] : svg.curve(panel, part).boxes) {
      double x = 0;
      SvgPoint low{0, 1e300}, high{0, -1e300};
      for (const auto& c : corners) {
        x += c.x / static_cast<double>(corners.size());
        if (c.y < low.y) low = c;
        if (c.y > high.y) high = c;
      }
      const auto values = svg.numbers(panel, {high, low}, kLin, kLin);
      by_size[svg.labelX('b', x)] = {values[0].y, values[1].y};
    }
    return by_size;
  };
  const std::vector<std::pair<double, double>> ten = {{0, 0.4}, {0.4, 0.7}, {0.7, 0.9}, {0.9, 1}},
                                               fifty = {
                                                   {0, 0.05}, {0.05, 0.2}, {0.2, 0.95}, {0.95, 1}};
  for (int part = 1; part <= 4; ++part) {
    auto seen = heights('a', part);
    const auto k = static_cast<std::size_t>(part - 1);
    ASSERT_EQ(seen.size(), 2u) << part;
    EXPECT_NEAR(seen["10"].first, ten[k].first, 0.01) << part;
    EXPECT_NEAR(seen["10"].second, ten[k].second, 0.01) << part;
    EXPECT_NEAR(seen["50"].first, fifty[k].first, 0.01) << part;
    EXPECT_NEAR(seen["50"].second, fifty[k].second, 0.01) << part;
    const auto schur = heights('b', part);
    ASSERT_EQ(schur.size(), 1u);
    EXPECT_EQ(schur.begin()->first, "10");
    EXPECT_NEAR(schur.begin()->second.second - schur.begin()->second.first, 0.1 * part, 0.01);
  }
}

TEST(FigureCurves, StepSize) {
  Drawing drawing;
  const auto put = [&](const char* name, const std::vector<SvgPoint>& steps) {
    std::vector<Cells> rows;
    for (const auto& s : steps) {
      rows.push_back({{"t", exact(s.x)},
                      {"h", exact(s.y)},
                      {"error", "0.5"},
                      {"newton_iterations", "9"},
                      {"x", "3"}});
    }
    drawing.put(name, {"t", "h", "error", "newton_iterations", "x"}, rows);
  };
  put("slider_crank.radau_iia_2.csv", {{0, NAN}, {0.1, 0.1}, {0.4, 0.3}, {1, 0.6}});
  put("slider_crank.radau_iia_5.csv", {{0, NAN}, {0.01, 0.01}, {0.05, 0.04}, {1, 0.95}});
  put("other.radau_iia_2.csv", {{0, NAN}, {0.2, 0.2}, {1, 0.8}});
  // No file other.radau_iia_5.csv: that run was not made, and its curve is left out without a warning.
  const Svg svg = drawing.draw(
      "step_size.gp",
      "cases='slider_crank other'; methods='radau_iia_2 radau_iia_5'; marks=\"'0.5'\"");
  const auto levels = [&](char panel, int curve) {  // the size at the end of each step
    std::vector<SvgPoint> ends;
    const auto line = svg.line(panel, curve, kLin, kLog);
    for (std::size_t i = 1; i < line.size(); ++i) {
      if (std::abs(line[i].x - line[i - 1].x) > 1e-3) ends.push_back(line[i]);
    }
    return ends;
  };
  const auto a = levels('a', 1), b = levels('a', 2), c = levels('b', 1);
  ASSERT_GE(a.size(), 2u);
  ASSERT_GE(b.size(), 2u);
  ASSERT_GE(c.size(), 1u);
  EXPECT_NEAR(a.back().x, 1, 0.01);
  EXPECT_NEAR(a.back().y, 0.6, 0.01);
  EXPECT_NEAR(a[a.size() - 2].x, 0.4, 0.01);
  EXPECT_NEAR(a[a.size() - 2].y, 0.3, 0.01);
  EXPECT_NEAR(b.back().y, 0.95, 0.02);
  EXPECT_NEAR(b[b.size() - 2].x, 0.05, 0.01);
  EXPECT_NEAR(b[b.size() - 2].y, 0.04, 0.001);
  EXPECT_NEAR(c.back().y, 0.8, 0.02);
}

// R = 1 / (1 - z): |R| = 1 on the circle of radius 1 about 1. R = (1 + z/2) / (1 - z/2): on the
// imaginary axis.
TEST(FigureCurves, Stability) {
  Drawing drawing;
  const auto root = [](const char* method, const char* family, const char* stages, const char* kind,
                       double re, double im) {
    return Cells{{"method", method}, {"family", family}, {"stages", stages},
                 {"root", kind},     {"re", exact(re)},  {"im", exact(im)}};
  };
  drawing.put(
      "stability.csv", {"method", "family", "stages", "root", "re", "im"},
      {root("radau_iia_1", "radau_iia", "1", "pole", 1, 0),
       root("gauss_1", "gauss", "1", "zero", -2, 0), root("gauss_1", "gauss", "1", "pole", 2, 0)});
  const Svg svg = drawing.draw("stability.gp", "families='radau_iia gauss'; stages='1'; extent=4");
  // Curve 1 and 2 are the shading of both halves, 3 and 4 the contour.
  for (const int half : {3, 4}) {
    const auto circle = svg.line('a', half, kLin, kLin);
    ASSERT_GT(circle.size(), 10u);
    for (const auto& p : circle) {
      EXPECT_NEAR(std::hypot(p.x - 1, p.y), 1, 0.05);
      EXPECT_GE(half == 3 ? p.y : -p.y, -0.02);
    }
    const auto axis = svg.line('b', half, kLin, kLin);
    ASSERT_GT(axis.size(), 5u);
    for (const auto& p : axis) EXPECT_NEAR(p.x, 0, 0.05);
  }
  // The order star of the implicit Euler method, with its pole at 1.
  const Svg star =
      drawing.draw("stability.gp", "families='radau_iia'; stages='1'; view='star'; extent=4");
  const auto pole = star.marks('a', 5, kLin, kLin);
  ASSERT_EQ(pole.size(), 1u);
  EXPECT_NEAR(pole[0].x, 1, 0.02);
  EXPECT_NEAR(pole[0].y, 0, 0.02);
  for (const auto& p : star.line('a', 3, kLin, kLin)) {  // |1 - z| = |e^-z|
    EXPECT_NEAR(std::log(std::hypot(p.x - 1, p.y)) + p.x, 0, 0.1) << p.x << " " << p.y;
  }
}

// Widths of the bars are shares of the runs.
TEST(FigureCurves, Audit) {
  Drawing drawing;
  const auto row = [](const char* by, const char* group) {
    return Cells{{"by", by},     {"group", group}, {"runs", "200"},           {"right", "100"},
                 {"failed", "60"}, {"wrong", "20"},  {"ill_conditioned", "12"}, {"unjudged", "8"}};
  };
  drawing.put("audit_summary.csv",
              {"by", "group", "runs", "right", "failed", "wrong", "ill_conditioned", "unjudged"},
              {row("all", "all"), row("scene", "kepler"), row("scene", "hires"),
               row("configuration", "default"), row("treatment", "locate"), row("family", "gauss")});
  const Svg svg = drawing.draw("audit.gp", "");
  const auto width = [&](char panel, int part) {
    double low = 1e300, high = -1e300;
    for (const auto& [colour, corners] : svg.curve(panel, part).boxes) {
      for (const auto& c : corners) low = std::min(low, c.x), high = std::max(high, c.x);
    }
    return high - low;
  };
  for (const char panel : {'a', 'b', 'c', 'd'}) {
    const double whole = width(panel, 1) / 0.5;
    EXPECT_NEAR(width(panel, 2) / whole, 0.3, 0.01) << panel;
    EXPECT_NEAR(width(panel, 3) / whole, 0.1, 0.01) << panel;
    EXPECT_NEAR(width(panel, 4) / whole, 0.1, 0.01) << panel;
  }
}

TEST(FigureCurves, AuditErrors) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* configuration, const char* judgement, double tolerance,
                       double ratio) {
    rows.push_back({{"run", std::to_string(rows.size())},
                    {"configuration", configuration},
                    {"judgement", judgement},
                    {"treatment", "default"},
                    {"tolerance", exact(tolerance)},
                    {"error", exact(tolerance * ratio)}});
  };
  for (const char* configuration : {"default", "paper", "embedded", "variable"}) {
    add(configuration, "right", 1e-4, 0.01);
    add(configuration, "right", 1e-8, 100);
    add(configuration, "wrong", 1e-6, 1e6);
  }
  drawing.put("audit.csv", {"run", "configuration", "judgement", "treatment", "tolerance", "error"},
              rows);
  const Svg svg = drawing.draw("audit_errors.gp", "");  // the third panel has both axes' labels
  auto right = svg.marks('c', 1, kLog, kLog), wrong = svg.marks('c', 3, kLog, kLog);
  ASSERT_EQ(right.size(), 2u);
  std::sort(right.begin(), right.end(), [](const auto& p, const auto& q) { return p.y < q.y; });
  EXPECT_NEAR(std::log10(right[0].y), -2, 0.1);
  EXPECT_NEAR(std::log10(right[0].x), -4, 0.4);
  EXPECT_NEAR(std::log10(right[1].y), 2, 0.1);
  EXPECT_NEAR(std::log10(right[1].x), -8, 0.4);
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_NEAR(std::log10(wrong[0].y), 6, 0.1);
}

// No script is left out above.
TEST(FigureCurves, EveryScriptIsDrawnByATest) {
  const std::filesystem::path source(IRK_SOURCE_DIR);
  std::ifstream in(source / "tests/experiments/report/figure_curves_test.cpp");
  const std::string tests{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  for (const auto& entry : std::filesystem::directory_iterator(source / "plots")) {
    const auto script = entry.path().filename().string();
    if (entry.path().extension() != ".gp" || script == "style.gp") continue;
    EXPECT_NE(tests.find("\"" + script + "\""), tests.npos) << script;
  }
}

}  // namespace
}  // namespace irk
