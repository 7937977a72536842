#include <fmt/format.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "experiments/tables/table.h"
#include "tests/experiments/report/drawn.h"
#include "tests/experiments/support.h"
#include "tests/experiments/svg.h"

namespace irk {
namespace {

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
              R"(scene,settings,formulation,method,component,power_of,family,stages,order,theory,h_min,h_max,verdict
riccati_tracking,,nan,nan,x,h,radau_iia,2,3.1,3,0.001,0.1,agrees
)");
  for (const std::string component : {"x", "u"}) {
    const Svg svg =
        drawing.draw("error_vs_step.gp", fmt::format("families='radau_iia gauss'; component='{}'", component));
    const auto expected = [&](int from) {  // sorted by h
      std::vector<SvgPoint> points;
      for (int i = from + 2; i >= from; --i) points.push_back({std::pow(0.1, i), numberOf("error_" + component, i)});
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
      EXPECT_NEAR(std::log(theory[2].y / theory[0].y) / std::log(theory[2].x / theory[0].x), 3, 0.03);
      EXPECT_NEAR(theory[0].x, 1e-3, 1e-5);
    }
  }
}

TEST(FigureCurves, EstimateRatio) {
  Drawing drawing;
  drawing.put("estimates.csv", R"(t,group,doubling,richardson
1,u,1,10
1,u,2,20
1,v,0.5,0.1
1,v,4,0.2
)");
  const Svg svg = drawing.draw("estimate_ratio.gp", "");
  // Sorted from the largest: half of the steps lie above it.
  expectPoints(svg.line('a', 1, kLog, kLog), {{2, 0.5}, {1, 1}}, "doubling u", 2e-2);
  expectPoints(svg.line('a', 2, kLog, kLog), {{4, 0.5}, {0.5, 1}}, "doubling v", 2e-2);
  expectPoints(svg.line('b', 1, kLog, kLog), {{20, 0.5}, {10, 1}}, "richardson u", 2e-2);
  expectPoints(svg.line('b', 2, kLog, kLog), {{0.2, 0.5}, {0.1, 1}}, "richardson v", 2e-2);
}

TEST(FigureCurves, Contraction) {
  Drawing drawing;
  // Three iterations are too few to be shown.
  drawing.put("contractions.csv", R"(scene,settings,iterations,c1,c2,c3,c4,c5,c6
pendulum,,4,0.1,0.01,nan,nan,nan,nan
pendulum,,4,0.2,0.02,nan,nan,nan,nan
pendulum,,4,0.4,0.04,nan,nan,nan,nan
pendulum,,3,5,5,nan,nan,nan,nan
kepler,,5,0.5,1,nan,nan,nan,nan
kepler,,5,0.5,1,nan,nan,nan,nan
kepler,,5,0.5,1,nan,nan,nan,nan
)");
  const Svg svg = drawing.draw("contraction.gp", "limit=0.3");
  expectPoints(svg.line('a', 3, kLin, kLog), {{1, 0.2}, {2, 0.02}}, "pendulum's medians", 2e-2);
  expectPoints(svg.line('b', 3, kLin, kLog), {{1, 0.5}, {2, 1}}, "kepler's medians", 2e-2);
  EXPECT_NEAR(svg.line('a', 1, kLin, kLog).front().y, 0.3, 6e-3) << "the limit";
  for (const auto& label : svg.panel('a').y) EXPECT_GT(label.pixel, 25) << "no room for the title";
}

TEST(FigureCurves, FailureMap) {
  Drawing drawing;
  // The second family has only one of the two numbers of stages.
  drawing.put("runs.csv", R"(scene,settings,method,family,stages,h,rtol,outcome,error,error_u
pendulum,,nan,radau_iia,2,0.1,1e-3,success,1e-3,1e-12
pendulum,,nan,radau_iia,2,0.01,1e-4,success,1e-12,1e-3
pendulum,,nan,radau_iia,3,0.1,1e-3,newton_failed,nan,nan
pendulum,,nan,radau_iia,3,0.01,1e-4,success,1e-3,1e-6
pendulum,,nan,lobatto_iiia,3,0.1,1e-3,success,1e-6,1e-6
)");
  const auto cellsOf = [](const Svg& svg) {  // colour by the labels of the cell
    std::map<std::string, std::string> cells;
    for (const auto& [colour, corners] : svg.curve('a', 1).boxes) {
      double x = 0, y = 0;
      for (const auto& c : corners)
        x += c.x / static_cast<double>(corners.size()), y += c.y / static_cast<double>(corners.size());
      cells[svg.labelX('a', x) + " " + svg.labelY('a', y)] = colour;
    }
    return cells;
  };
  auto cells = cellsOf(drawing.draw("failure_map.gp", "scene='pendulum'"));
  ASSERT_EQ(cells.size(), 3u);
  ASSERT_TRUE(cells.contains("2 10^-1") && cells.contains("2 10^-2") && cells.contains("3 10^-2"));
  EXPECT_EQ(cells["2 10^-1"], cells["3 10^-2"]) << "three digits";
  EXPECT_NE(cells["2 10^-1"], cells["2 10^-2"]);
  auto of_u = cellsOf(drawing.draw("failure_map.gp", "scene='pendulum'; quantity='error_u'; y='rtol'"));
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

const std::string kOrderColumns =
    "scene,settings,component,power_of,family,stages,method,theory,order,confidence,verdict\n";

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
  drawing.put("orders.csv", kOrderColumns + R"(kaps,,x,h,radau_iia,1,nan,1,1.2,0.1,agrees
kaps,,x,h,radau_iia,2,nan,3,2.6,0.1,agrees
kaps,,x,h,radau_iia,4,nan,7,5.4,0.1,differs
kaps,,z,h,radau_iia,2,nan,9,9,0.1,agrees
)");
  const Svg svg = drawing.draw("order_vs_stages.gp", "scene='kaps'; components='x'");
  expectPoints(svg.line('a', 1, kLin, kLin), {{1, 1}, {2, 3}, {4, 7}}, "theory", 1e-2);
  expectPoints(once(svg.marks('a', 2, kLin, kLin)), {{1, 1.2}, {2, 2.6}, {4, 5.4}}, "measured", 1e-2);
  expectPoints(svg.marks('a', 3, kLin, kLin), {{4, 5.4}}, "differs", 1e-2);
  const Svg both = drawing.draw("order_vs_stages.gp", "scene='kaps'; components='x z'");
  const auto z = once(both.marks('a', 4, kLin, kLin));
  ASSERT_EQ(z.size(), 1u);
  EXPECT_NEAR(z[0].y, 9, 0.1);
}

// Measured for 2 and 5 stages only: theory is drawn for all, and the legend explains only marks that are there.
TEST(FigureCurves, TheoryOfOrdersForEveryNumberOfStages) {
  Drawing drawing;
  drawing.put("orders.csv", kOrderColumns + R"(kaps,,x,h,gauss,2,gauss_2,2,2,0.1,agrees
kaps,,x,h,gauss,5,gauss_5,6,6,0.1,agrees
)");
  drawing.put("order_theory.csv", R"(scene,settings,method,component,power_of,family,stages,theory
kaps,,gauss_1,x,h,gauss,1,2
kaps,,gauss_2,x,h,gauss,2,2
kaps,,gauss_3,x,h,gauss,3,4
kaps,,gauss_4,x,h,gauss,4,4
kaps,,gauss_5,x,h,gauss,5,6
)");
  const Svg svg = drawing.draw("order_vs_stages.gp", "scene='kaps'; components='x'");
  const auto line = svg.line('a', 1, kLin, kLin);
  const auto through = [&](double x, double y) {
    return std::any_of(line.begin(), line.end(),
                       [&](auto& p) { return std::abs(p.x - x) < 0.02 && std::abs(p.y - y) < 0.05; });
  };
  EXPECT_TRUE(through(2, 2) && through(3, 4) && through(4, 4) && through(5, 6)) << "the steps of even and odd stages";
  EXPECT_EQ(svg.occurrences("not measurable"), 0);
  EXPECT_EQ(svg.occurrences("differs"), 0);
}

TEST(FigureCurves, OrderVsStiffness) {
  Drawing drawing;
  // Without a setting lambda is -1e8; over h there is no single stiffness.
  drawing.put("orders.csv", kOrderColumns + R"(prothero_robinson,lambda=-1e2,x,h,gauss,2,nan,nan,3.9,0.3,agrees
prothero_robinson,lambda=-1e4,x,h,gauss,2,nan,nan,2.5,0.3,agrees
prothero_robinson,,x,h,gauss,2,nan,3,2.1,0.3,agrees
prothero_robinson,lambda=-1e2,x,h,gauss,3,nan,nan,5.9,0.3,agrees
prothero_robinson,lambda=-1e4,x,h,gauss,3,nan,nan,nan,0.3,not_measurable
prothero_robinson,,x,h,gauss,3,nan,nan,4.4,0.3,agrees
prothero_robinson,lambda=-1e8/h,x,h,gauss,2,nan,nan,11,0.3,agrees
)");
  const Svg svg = drawing.draw("order_vs_stiffness.gp", "scene='prothero_robinson'");
  // For each of two numbers of stages: the bars of theory, the lines, the plus signs.
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

}  // namespace
}  // namespace irk
