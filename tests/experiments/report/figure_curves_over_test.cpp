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
  drawing.put("tableaus.csv", {"family", "stages", "order", "error_constant", "condition_A", "condition_eigenvectors"},
              rows);
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
  std::vector<Cells> rows;
  const auto add = [&](const char* target, const char* integrator, double ratio, double fraction,
                       const char* collection = "all") {
    rows.push_back({{"collection", collection},
                    {"target_error", target},
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
  add("1e-4", "variable", 4, 0.7, "ivp");
  add("1e-4", "variable", 40, 0.9, "ivp");
  drawing.put("profile.csv", {"collection", "target_error", "problems", "integrator", "ratio", "fraction"}, rows);
  const Svg svg = drawing.draw("profile.gp", "targets='-4 -8'");
  expectPoints(svg.line('a', 1, kLog, kLin), {{1, 0.5}, {10, 0.5}, {10, 0.8}}, "variable", 2e-2);
  expectPoints(svg.line('a', 2, kLog, kLin), {{2, 0.2}, {50, 0.2}, {50, 0.9}}, "cvode", 2e-2);
  expectPoints(svg.line('b', 1, kLog, kLin), {{3, 0.3}, {30, 0.3}, {30, 0.6}}, "1e-8", 2e-2);
  const Svg of_collection = drawing.draw("profile.gp", "targets='-4'; collection='ivp'");
  expectPoints(of_collection.line('a', 1, kLog, kLin), {{4, 0.7}, {40, 0.7}, {40, 0.9}}, "variable on ivp", 2e-2);
}

TEST(FigureCurves, Scaling) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](const char* method, const char* solver, const char* storage, const char* threads, int n,
                       double step) {
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
  add("radau_iia_5", "schur", "automatic", "2", 1000, 4e-3);  // a lone mark is no curve
  drawing.put("scaling.csv", {"scene", "method", "solver", "storage", "threads", "n", "steps", "step_s"}, rows);
  const Svg svg = drawing.draw("scaling.gp", "");
  expectPoints(svg.marks('a', 2, kLog, kLog), {{10, 1e-5}, {100, 2e-4}, {1000, 7e-3}}, "sparse");
  expectPoints(svg.marks('a', 3, kLog, kLog), {{10, 3e-5}, {100, 5e-2}}, "dense");
  expectPoints(svg.marks('b', 2, kLog, kLog), {{10, 4e-5}, {1000, 6e-3}}, "five stages");
  EXPECT_EQ(svg.occurrences("decoupled, sparse</text>"), 1);
  EXPECT_EQ(svg.occurrences("2 threads"), 0) << "not drawn, so not in the legend";

  // The time that passes says nothing about one thread if other programs run beside it.
  for (auto& row : rows) row["step_cpu_s"] = exact(2e-5);
  drawing.put("scaling.csv", {"scene", "method", "solver", "storage", "threads", "n", "steps", "step_s", "step_cpu_s"},
              rows);
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
              {"t", "h", "error", "newton_iterations", "switches", "x", "y", "x'", "y'", "lambda"}, rows);
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
  drawing.put("mine.radau_iia_5.csv", {"t", "h", "error", "newton_iterations", "switches", "p"},
              {{{"t", "0"}, {"h", "9"}, {"p", "1"}}, {{"t", "2"}, {"h", "9"}, {"p", "4"}}});
  const Svg own = drawing.draw("scene_solution.gp", "scene='mine'");
  expectPoints(own.line('a', 1, kLin, kLin), {{0, 1}, {2, 4}}, "p", 2e-2);
  EXPECT_TRUE(own.panel('b').curves.empty());
}

TEST(FigureCurves, Shares) {
  Drawing drawing;
  std::vector<Cells> rows;
  const auto add = [&](int n, const char* solver, double residual, double jacobian, double factorization,
                       double solve) {
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
              {"scene", "derivatives", "solver", "method", "n", "factorization_s", "share_residual", "share_jacobian",
               "share_factorization", "share_solve", "share_update", "share_step", "share_start"},
              rows, "0");
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
  const std::vector<std::pair<double, double>> ten = {{0, 0.4}, {0.4, 0.7}, {0.7, 0.9}, {0.9, 1}},
                                               fifty = {{0, 0.05}, {0.05, 0.2}, {0.2, 0.95}, {0.95, 1}};
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

}  // namespace
}  // namespace irk
