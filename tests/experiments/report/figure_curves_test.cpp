// Every gnuplot script draws a synthetic table without two equal columns; the test reads the curves back.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "experiments/tables/table.h"
#include "tests/experiments/report/drawn.h"
#include "tests/experiments/support.h"
#include "tests/experiments/svg.h"

namespace irk {
namespace {

TEST(FigureCurves, StepSize) {
  Drawing drawing;
  const std::string columns = "t,h,error,newton_iterations,x\n0,nan,0.5,9,3\n";
  drawing.put("slider_crank.radau_iia_2.csv", columns + "0.1,0.1,0.5,9,3\n0.4,0.3,0.5,9,3\n1,0.6,0.5,9,3\n");
  drawing.put("slider_crank.radau_iia_5.csv", columns + "0.01,0.01,0.5,9,3\n0.05,0.04,0.5,9,3\n1,0.95,0.5,9,3\n");
  drawing.put("other.radau_iia_2.csv", columns + "0.2,0.2,0.5,9,3\n1,0.8,0.5,9,3\n");
  // The file other.radau_iia_5.csv does not exist: that curve is left out without a warning.
  const Svg svg =
      drawing.draw("step_size.gp", "cases='slider_crank other'; methods='radau_iia_2 radau_iia_5'; marks=\"'0.5'\"");
  const auto levels = [&](char panel, int curve) {  // the size at the end of each step
    std::vector<SvgPoint> ends;
    const auto line = svg.line(panel, curve, kLin, kLog);
    for (std::size_t i = 1; i < line.size(); ++i) {
      if (std::abs(line[i].x - line[i - 1].x) > 1e-3) ends.push_back(line[i]);
    }
    return ends;
  };
  const auto a = levels('a', 1), b = levels('a', 2), c = levels('b', 1);
  ASSERT_GE(a.size(), 3u);
  ASSERT_GE(b.size(), 2u);
  ASSERT_GE(c.size(), 1u);
  EXPECT_NEAR(a.back().x, 1, 0.01);
  EXPECT_NEAR(a.back().y, 0.6, 0.01);
  EXPECT_NEAR(a[a.size() - 3].x, 0.1, 0.01) << "the first step, from the start on";
  EXPECT_NEAR(a[a.size() - 3].y, 0.1, 0.01);
  EXPECT_NEAR(a[a.size() - 2].x, 0.4, 0.01);
  EXPECT_NEAR(a[a.size() - 2].y, 0.3, 0.01);
  EXPECT_NEAR(b.back().y, 0.95, 0.02);
  EXPECT_NEAR(b[b.size() - 2].x, 0.05, 0.01);
  EXPECT_NEAR(b[b.size() - 2].y, 0.04, 0.001);
  EXPECT_NEAR(c.back().y, 0.8, 0.02);
}

// R = 1 / (1 - z): |R| = 1 on the circle of radius 1 about 1. R = (1 + z/2) / (1 - z/2): |R| = 1 on the imaginary
// axis.
TEST(FigureCurves, Stability) {
  Drawing drawing;
  drawing.put("stability.csv", R"(method,family,stages,root,re,im
radau_iia_1,radau_iia,1,pole,1,0
gauss_1,gauss,1,zero,-2,0
gauss_1,gauss,1,pole,2,0
)");
  const Svg svg = drawing.draw("stability.gp", "families='radau_iia gauss'; stages='1'; extent=4");
  // Curves 1 and 2 are the shading of the two halves, curves 3 and 4 the contour.
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
  const Svg star = drawing.draw("stability.gp", "families='radau_iia'; stages='1'; view='star'; extent=4");
  const auto pole = star.marks('a', 5, kLin, kLin);
  ASSERT_EQ(pole.size(), 1u);
  EXPECT_NEAR(pole[0].x, 1, 0.02);
  EXPECT_NEAR(pole[0].y, 0, 0.02);
  for (const auto& p : star.line('a', 3, kLin, kLin)) {  // |1 - z| = |e^-z|
    EXPECT_NEAR(std::log(std::hypot(p.x - 1, p.y)) + p.x, 0, 0.1) << p.x << " " << p.y;
  }
}

// The widths of the bars are the shares of the runs.
TEST(FigureCurves, Audit) {
  Drawing drawing;
  drawing.put("audit_summary.csv", R"(by,group,runs,right,failed,wrong,ill_conditioned,unjudged
all,all,200,100,60,20,12,8
scene,kepler,200,100,60,20,12,8
scene,hires,200,100,60,20,12,8
configuration,default,200,100,60,20,12,8
treatment,locate,200,100,60,20,12,8
family,gauss,200,100,60,20,12,8
)");
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
  const auto add = [&](const char* integrator, const char* judgement, double tolerance, double ratio) {
    rows.push_back({{"run", std::to_string(rows.size())},
                    {"integrator", integrator},
                    {"configuration", integrator == std::string("cvode_bdf") ? "embedded" : integrator},
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
  add("cvode_bdf", "wrong", 1e-6, 1e4);  // of another library: in no panel
  drawing.put("audit.csv", {"run", "integrator", "configuration", "judgement", "treatment", "tolerance", "error"},
              rows);
  const Svg svg = drawing.draw("audit_errors.gp", "");  // the third panel has labels on both axes
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

// Every script is drawn by a test above.
TEST(FigureCurves, EveryScriptIsDrawnByATest) {
  const std::filesystem::path source(IRK_SOURCE_DIR);
  std::string tests;
  for (const auto& entry : std::filesystem::directory_iterator(source / "tests/experiments/report")) {
    tests += readInputFile(entry.path());
  }
  for (const auto& entry : std::filesystem::directory_iterator(source / "plots")) {
    const auto script = entry.path().filename().string();
    if (entry.path().extension() != ".gp" || script == "style.gp") continue;
    EXPECT_NE(tests.find("\"" + script + "\""), tests.npos) << script;
  }
}

}  // namespace
}  // namespace irk
