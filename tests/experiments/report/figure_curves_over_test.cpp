#include <fmt/format.h>
#include <gtest/gtest.h>
#include <cmath>
#include <iterator>
#include <map>

#include "experiments/tables/table.h"
#include "tests/experiments/report/drawn.h"
#include "tests/experiments/support.h"
#include "tests/experiments/svg.h"

namespace irk {
namespace {

TEST(FigureCurves, OverStages) {
  Drawing drawing;
  drawing.put("tableaus.csv", R"(family,stages,order,error_constant,condition_A,condition_eigenvectors
gauss,2,99,-0.01,10,300
gauss,4,99,-0.1,100,20
gauss,6,99,-0.7,700,5000
radau_iia,2,99,-0.02,20,60
radau_iia,4,99,-0.005,5,900
)");
  const Svg svg = drawing.draw("over_stages.gp", "");
  expectPoints(svg.marks('a', 1, kLin, kLog), {{2, 10}, {4, 100}, {6, 700}}, "gauss");
  expectPoints(svg.marks('a', 2, kLin, kLog), {{2, 20}, {4, 5}}, "radau");
  expectPoints(svg.marks('b', 1, kLin, kLog), {{2, 300}, {4, 20}, {6, 5000}}, "gauss, eigenvectors");
  const Svg constants = drawing.draw("over_stages.gp", "quantities='error_constant'");
  expectPoints(constants.marks('a', 1, kLin, kLog), {{2, 0.01}, {4, 0.1}, {6, 0.7}}, "magnitudes");
}

TEST(FigureCurves, OverStep) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* formulation, const char* scaling, int from, const char* outcome) {
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
  const Svg svg = drawing.draw("over_step.gp", "quantities='error_z error_v iterations new_jacobians'");
  const auto expected = [&](const char* quantity, int from) {
    std::vector<SvgPoint> points;  // smooth unique: by ascending h
    for (int i = from + 2; i >= from; --i) {
      points.push_back({std::pow(0.1, i), quantity == std::string("iterations")
                                              ? numberOf("newton_iterations", i) / numberOf("steps_accepted", i)
                                          : quantity == std::string("new_jacobians")
                                              ? numberOf("jacobians", i) / numberOf("steps_accepted", i)
                                              : numberOf(quantity, i)});
    }
    return points;
  };
  expectPoints(svg.marks('a', 1, kLog, kLog), expected("error_z", 1), "z, scaled");
  expectPoints(svg.marks('a', 2, kLog, kLog), expected("error_z", 2), "z, unscaled");
  expectPoints(svg.marks('b', 1, kLog, kLog), expected("error_v", 1), "v");
  expectPoints(svg.marks('c', 1, kLog, kLin), expected("iterations", 1), "iterations", 1e-2);
  expectPoints(svg.marks('d', 1, kLog, kLog), expected("new_jacobians", 1), "Jacobians");
}

TEST(FigureCurves, Profile) {
  Drawing drawing;
  drawing.put("profile.csv", R"(collection,target_error,problems,integrator,ratio,fraction
all,1e-4,55,variable,1,0.5
all,1e-4,55,variable,10,0.8
all,1e-4,55,cvode_bdf,2,0.2
all,1e-4,55,cvode_bdf,50,0.9
all,1e-8,55,variable,3,0.3
all,1e-8,55,variable,30,0.6
ivp,1e-4,55,variable,4,0.7
ivp,1e-4,55,variable,40,0.9
)");
  const Svg svg = drawing.draw("profile.gp", "targets='-4 -8'");
  expectPoints(svg.line('a', 1, kLog, kLin), {{1, 0.5}, {10, 0.5}, {10, 0.8}}, "variable", 2e-2);
  expectPoints(svg.line('a', 2, kLog, kLin), {{2, 0.2}, {50, 0.2}, {50, 0.9}}, "cvode", 2e-2);
  expectPoints(svg.line('b', 1, kLog, kLin), {{3, 0.3}, {30, 0.3}, {30, 0.6}}, "1e-8", 2e-2);
  const Svg of_collection = drawing.draw("profile.gp", "targets='-4'; collection='ivp'");
  expectPoints(of_collection.line('a', 1, kLog, kLin), {{4, 0.7}, {40, 0.7}, {40, 0.9}}, "variable on ivp", 2e-2);
}

TEST(FigureCurves, Scaling) {
  Drawing drawing;
  // A lone mark, as of two threads, is no curve.
  const auto table = [](const std::string& name, const std::string& cell) {
    std::string csv = "scene,method,solver,storage,threads,n,steps,step_s" + name + "\n";
    for (const char* const row :
         {"radau_iia_3,schur,sparse,1,10,9e5,1e-5", "radau_iia_3,schur,sparse,1,100,45000,2e-4",
          "radau_iia_3,schur,sparse,1,1000,1285,7e-3", "radau_iia_3,schur,dense,1,10,3e5,3e-5",
          "radau_iia_3,schur,dense,1,100,180,5e-2", "radau_iia_5,schur,sparse,1,10,225000,4e-5",
          "radau_iia_5,schur,sparse,1,1000,1500,6e-3", "radau_iia_5,schur,automatic,2,1000,2250,4e-3"}) {
      csv += "beam_chain," + std::string(row) + cell + "\n";
    }
    return csv;
  };
  drawing.put("scaling.csv", table("", ""));
  const Svg svg = drawing.draw("scaling.gp", "");
  expectPoints(svg.marks('a', 2, kLog, kLog), {{10, 1e-5}, {100, 2e-4}, {1000, 7e-3}}, "sparse");
  expectPoints(svg.marks('a', 3, kLog, kLog), {{10, 3e-5}, {100, 5e-2}}, "dense");
  expectPoints(svg.marks('b', 2, kLog, kLog), {{10, 4e-5}, {1000, 6e-3}}, "five stages");
  EXPECT_EQ(svg.occurrences("decoupled, sparse</text>"), 1);
  EXPECT_EQ(svg.occurrences("2 threads"), 0) << "not drawn, so not in the legend";

  // The time that passes says nothing about one thread if other programs run beside it.
  drawing.put("scaling.csv", table(",step_cpu_s", ",2e-5"));
  const Svg of_cpu = drawing.draw("scaling.gp", "");
  expectPoints(of_cpu.marks('a', 2, kLog, kLog), {{10, 2e-5}, {100, 2e-5}, {1000, 2e-5}}, "CPU time of one thread");
}

TEST(FigureCurves, Parallel) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* scene, const char* way, int processors, double speedup) {
    rows.push_back({{"scene", scene},
                    {"settings", "m=100 damping=0"},
                    {"storage", "sparse"},
                    {"way", way},
                    {"processors", std::to_string(processors)},
                    {"speedup", exact(speedup)}});
  };
  for (const char* const way : {"threads", "runs"}) {
    const double gain = way[0] == 't' ? 0.5 : 0.9;
    for (const int p : {1, 2, 6}) add("heat", way, p, 1 + gain * (p - 1));
    for (const int p : {1, 2, 6}) add("beam_chain", way, p, 1 + 0.1 * (p - 1));
  }
  drawing.put("parallel.csv", {"scene", "settings", "storage", "way", "processors", "speedup"}, rows);
  const Svg svg = drawing.draw("times/parallel.gp", "titles=\"'heat conduction' beam\"");
  expectPoints(svg.marks('a', 2, kLog, kLog), {{1, 1}, {2, 1.5}, {6, 3.5}}, "one run");
  expectPoints(svg.marks('a', 3, kLog, kLog), {{1, 1}, {2, 1.1}, {6, 1.5}}, "one run, beam");
  expectPoints(svg.marks('b', 2, kLog, kLog), {{1, 1}, {2, 1.9}, {6, 5.5}}, "several runs");
  EXPECT_EQ(svg.occurrences("heat conduction</text>"), 1);
}

TEST(FigureCurves, SceneSolution) {
  Drawing drawing;
  drawing.put("pendulum.radau_iia_5.csv", R"(t,h,error,newton_iterations,switches,x,y,x',y',lambda
0,5,6,7,8,1,9,0,3,10
1,5,6,7,8,2,7,1,2,15
3,5,6,7,8,4,3,9,0,25
4,5,6,7,8,5,1,16,-1,30
)");
  const Svg svg =
      drawing.draw("scene_solution.gp",
                   "scene='pendulum'; panels='\"positions|x y|1\" \"velocities|x'' y''|1\" \"multiplier|lambda|1\"'");
  const auto near = [&](char panel, int curve, const std::vector<SvgPoint>& expected, const char* what) {
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
  // A scene without a layout gets one panel per column, except the columns of the steps.
  drawing.put("mine.radau_iia_5.csv", "t,h,error,newton_iterations,switches,p\n0,9,nan,nan,nan,1\n2,9,nan,nan,nan,4\n");
  const Svg own = drawing.draw("scene_solution.gp", "scene='mine'");
  expectPoints(own.line('a', 1, kLin, kLin), {{0, 1}, {2, 4}}, "p", 2e-2);
  EXPECT_TRUE(own.panel('b').curves.empty());
}

TEST(FigureCurves, Shares) {
  Drawing drawing;
  drawing.put(
      "phases.csv",
      R"(scene,derivatives,solver,method,n,factorization_s,share_residual,share_jacobian,share_factorization,share_solve,)"
      R"(share_filter_factorization,share_filter_solve,share_update,share_step,share_start
ancf_pendulum,difference_forward,coupled_dense,radau_iia_3,10,0.77,0.4,0.2,0.2,0.1,0.04,0.06,0,0,0
ancf_pendulum,difference_forward,coupled_dense,radau_iia_3,50,0.77,0.05,0.15,0.65,0.05,0.03,0.07,0,0,0
ancf_pendulum,difference_forward,schur,radau_iia_3,10,0.77,0.0667,0.1333,0.2,0.2667,0.1333,0.2,0,0,0
)");
  const Svg svg = drawing.draw("shares.gp", "methods='radau_iia_3'");
  const auto heights = [&](char panel, int part) {
    std::map<std::string, std::pair<double, double>> by_size;  // bottom and top, by the labels of the last row
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
  const std::vector<std::pair<double, double>> ten = {{0, 0.4}, {0.4, 0.6}, {0.6, 0.8}, {0.8, 0.9}, {0.9, 1}},
                                               fifty = {{0, 0.05}, {0.05, 0.2}, {0.2, 0.85}, {0.85, 0.9}, {0.9, 1}};
  for (int part = 1; part <= 5; ++part) {
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
    EXPECT_NEAR(schur.begin()->second.second - schur.begin()->second.first, part / 15.0, 0.01);
  }
}

}  // namespace
}  // namespace irk
