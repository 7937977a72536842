// Evaluations of claims about switches, contact, friction and reliability: made-up tables on both sides of their
// thresholds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/claims/verdict.h"
#include "tests/experiments/claim_tables.h"
#include "tests/experiments/support.h"

namespace irk::claims {
namespace {

Measurement measured(std::string_view id, const ResultTables& tables, Setting setting = Setting::kPaper) {
  return evaluationOf(id)(tables, setting);
}
Verdict verdictOf(std::string_view id, const ResultTables& tables, Setting setting = Setting::kPaper) {
  return judge(partOf(id), measured(id, tables, setting)).verdict;
}

constexpr const char* kScenes[] = {"kepler", "pendulum", "slider_crank"};

// --- C3b, steps

ResultTables estimates(double ratio, const char* group, int of_ten_above = 0) {
  Table table{{}, {"scene", "formulation", "group", "doubling"}, {}};
  for (const char* scene : kScenes) {
    for (int i = 0; i < 10; ++i) {
      table.rows.push_back({scene, "index2", group, text(i < of_ten_above ? 5 : ratio)});
      table.rows.push_back({scene, "index3", group, "100"});  // not of the paper
      table.rows.push_back({scene, "index2", "z", "100"});    // multipliers do not count
    }
  }
  return resultsOf("estimate", "estimates", table);
}

TEST(SwitchingClaims, ReliableSteps) {
  for (const char* group : {"u", "v", "x"}) {
    const std::string part = std::string("C3b") + group;
    EXPECT_EQ(verdictOf(part, estimates(4, group)), kYes) << group;
    EXPECT_EQ(verdictOf(part, estimates(4.001, group)), kNo) << group;
    EXPECT_EQ(verdictOf(part, estimates(4, group, 1)), kNo) << "90 % are not 95 %";
    EXPECT_EQ(verdictOf(part, estimates(1, "w")), kUnknown) << group;
  }
}

// --- C3b, runs, and C16: errors at ten times

struct Reliability {
  double jump = 1, smooth = 1;  // largest error of a run, in tolerances
  int jumps = 9;                // runs per scene with jumps
  const char* outcome = "success";
};

ResultTables reliability(const Reliability& r, const char* treatment = "ignore", const char* configuration = "paper") {
  Table table{{},
              {"block", "configuration", "scene", "settings", "method", "discontinuity", "rtol", "t_end", "outcome",
               "residuals", "dual_residuals", "error", "error_u", "error_v", "error_x"},
              {}};
  const auto addRun = [&](const char* block, const std::string& scene, int i, const char* treated, double value,
                          const char* outcome, const char* residuals) {
    for (int time = 1; time <= 10; ++time) {
      // The largest error, of v, is that at the fourth time; that of u is small.
      const double error = (time == 4 ? 1.0 : 0.1) * value * 1e-3;
      table.rows.push_back({block, configuration, scene, "", "radau_iia_" + std::to_string(i), treated, "1e-3",
                            std::to_string(time), outcome, residuals, treated == std::string("locate") ? "20" : "30",
                            "nan", "1e-9", text(error), "nan"});
    }
  };
  for (const char* block : {"contact", "friction", "sampling"}) {
    for (int i = 0; i < r.jumps; ++i) {
      addRun(block, block, i, treatment, r.jump, r.outcome, "30");
      addRun(block, block, i, "locate", 1, "success", "20");
    }
  }
  for (const char* block : {"orbit", "pendulum", "tracking"}) {
    for (int i = 0; i < 9; ++i) addRun(block, block, i, "ignore", r.smooth, "success", "10");
  }
  return resultsOf("reliability", "runs", table);
}

TEST(SwitchingClaims, ReliableRuns) {
  EXPECT_EQ(verdictOf("C3br", reliability({.jump = 9.99, .smooth = 9.99})), kYes);
  EXPECT_EQ(verdictOf("C3br", reliability({.jump = 10.1, .smooth = 10.1})), kNo);
  EXPECT_EQ(verdictOf("C3br", reliability({.jump = 20, .smooth = 1})), kNo) << "half of the runs";
  EXPECT_EQ(verdictOf("C3br", reliability({.jumps = 8})), kUnknown) << "24 runs with jumps";
  EXPECT_EQ(verdictOf("C3br", reliability({.outcome = "step_too_small"})), kNo) << "failed: no tolerance is reached";
}

TEST(SwitchingClaims, TolerancesWithoutLocatedSwitches) {
  for (const auto& [part, treatment] : {std::pair("C16a", "ignore"), std::pair("C16b", "iterate")}) {
    EXPECT_EQ(verdictOf(part, reliability({.jump = 9.99}, treatment)), kYes);
    EXPECT_EQ(verdictOf(part, reliability({.jump = 10.1}, treatment)), kNo);
    EXPECT_EQ(verdictOf(part, reliability({.outcome = "max_steps"}, treatment)), kNo) << "failed";
    EXPECT_EQ(verdictOf(part, reliability({.jump = 9.99}, treatment, "embedded"), Setting::kBest), kYes);
  }
  EXPECT_THROW(measured("C16a", reliability({}), Setting::kBest), MissingResults) << "the paper's runs only";
  for (const auto& [part, treatment] : {std::pair("C16c", "ignore"), std::pair("C16d", "iterate")}) {
    const auto judged = judge(partOf(part), measured(part, reliability({}, treatment)));
    EXPECT_EQ(judged.verdict, Verdict::kReported);
    EXPECT_EQ(judged.value, 1.5) << "30 + 30 over 20 + 20 evaluations";
  }
}

// --- C9b

// Steps of 0.01, and one of `factor` times that over each switch.
Table stepsWithSwitches(const std::vector<double>& times, double end, double factor) {
  Table steps{{}, {"t", "h"}, {}};
  const double h = end / 50;
  double t = 0;
  while (t < end) {
    double step = h;
    for (const double at : times) {
      if (t <= at && at < t + h) step = std::max(h * factor, at - t);
    }
    t += step;
    bool over = false;
    for (const double at : times) over = over || (t - step <= at && at <= t);
    steps.rows.push_back({fmt::format("{:.12g}", t), fmt::format("{:.12g}", over ? h * factor : h)});
  }
  return steps;
}

ResultTables lively(double factor) {
  Table runs{{}, {"block", "scene", "settings", "method", "outcome"}, {}};
  ResultTables results;
  const auto add = [&](const char* block, const char* scene, const char* settings, const std::string& file,
                       const std::vector<double>& times, double end) {
    for (const char* method : {"radau_iia_2", "radau_iia_5"}) {
      runs.rows.push_back({block, scene, settings, method, "success"});
      results.put("steps", file + "." + method, stepsWithSwitches(times, end, factor));
    }
  };
  add("torque_level", "slider_crank", "T2=0.05 torque_every=0.5", "slider_crank_T2_0.05_torque_every_0.5", {0.5}, 1);
  add("sampling", "sampled_control", "", "sampled_control", {0.1, 0.2, 0.3, 0.4}, 0.45);
  add("chopper", "dc_motor_chopper", "", "dc_motor_chopper", {0.002337477488598, 0.007248769114225, 0.008261944369415},
      0.01);
  // Not lively behind its switch, so that it must not count.
  runs.rows.push_back({"crank_torque_off", "slider_crank", "torque_off_at=0.5", "radau_iia_2", "success"});
  results.put("steps", "runs", runs);
  return results;
}

TEST(SwitchingClaims, StepsAtSwitches) {
  const auto cases = measured("C9b", lively(0.25)).cases;
  EXPECT_EQ(cases.size(), 16u);  // 8 switches, 2 methods
  for (const auto& one : cases) EXPECT_NEAR(one.value, 0.25, 1e-9) << one.scene;
  EXPECT_EQ(verdictOf("C9b", lively(0.333)), kYes);
  EXPECT_EQ(verdictOf("C9b", lively(0.334)), kNo);
}

// --- C17

ResultTables contractions(double third, int of_ten_better = 0) {
  Table table{{}, {"scene", "c1", "c3"}, {}};
  for (const char* scene : kScenes) {
    for (int i = 0; i < 10; ++i) table.rows.push_back({scene, "0.5", text(i < of_ten_better ? 0.1 : third)});
  }
  return resultsOf("contraction", "contractions", table);
}

TEST(SwitchingClaims, ContractionAtFirst) {
  EXPECT_EQ(verdictOf("C17", contractions(0.499)), kYes);
  EXPECT_EQ(verdictOf("C17", contractions(0.5)), kNo) << "equal is not better";
  EXPECT_EQ(verdictOf("C17", contractions(0.6, 8)), kYes);
  EXPECT_EQ(verdictOf("C17", contractions(0.6, 7)), kNo);
}

// --- C18

ResultTables newtonRuns(const char* modified, const char* full, double error) {
  Table table{{}, {"scene", "settings", "method", "rtol", "discontinuity", "h", "newton", "outcome", "error"}, {}};
  for (const char* scene : kScenes) {
    for (const char* h : {"0.1", "0.2", "0.3", "0.4"}) {
      const auto add = [&](const char* newton, const char* outcome, double reached) {
        table.rows.push_back({scene, "", "radau_iia_3", "nan", "smooth", h, newton, outcome, text(reached)});
      };
      const bool hard = std::string(h) == "0.3" && std::string(scene) == "pendulum";  // one case only
      add("modified_only", hard ? modified : "success", 0.01);
      add("full", hard ? full : "success", hard ? error : 0.01);
      add("modified", "newton_failed", 0.01);
    }
  }
  return resultsOf("newton_contact", "runs", table);
}

TEST(SwitchingClaims, FullNewtonRepairs) {
  EXPECT_EQ(verdictOf("C18", newtonRuns("newton_failed", "success", 0.1)), kYes) << "one case suffices";
  EXPECT_EQ(verdictOf("C18", newtonRuns("newton_failed", "success", 0.11)), kNo) << "no solution that can be used";
  EXPECT_EQ(verdictOf("C18", newtonRuns("newton_failed", "newton_failed", 0.01)), kNo);
  EXPECT_EQ(verdictOf("C18", newtonRuns("success", "success", 0.01)), kNo);
  EXPECT_EQ(verdictOf("C18", newtonRuns("timeout", "success", 0.01)), kNo) << "not a failure of Newton's method";
}

// --- C19

ResultTables gammaRuns(int with, int without) {
  Table table{{}, {"block", "scene", "settings", "method", "rtol", "control", "outcome", "steps_rejected_error"}, {}};
  for (const char* scene : kScenes) {
    for (const char* method : {"radau_iia_2", "radau_iia_3", "radau_iia_4", "radau_iia_5"}) {
      const auto add = [&](const char* rtol, const char* control, int rejected, const char* outcome) {
        table.rows.push_back({"gamma_smooth", scene, "", method, rtol, control, outcome, std::to_string(rejected)});
      };
      add("1e-3", "paper", with, "success");
      add("1e-3", "paper_no_gamma", without, "success");
      add("1e-5", "paper", 10, "success");
      add("1e-5", "paper_no_gamma", 10, "success");
      add("1e-7", "paper", 1000, "success");
      add("1e-7", "paper_no_gamma", 1, "max_steps");  // nothing to compare with
    }
  }
  return resultsOf("control", "runs", table);
}

TEST(SwitchingClaims, Gamma) {
  EXPECT_EQ(verdictOf("C19", gammaRuns(20, 20)), kYes);
  EXPECT_EQ(verdictOf("C19", gammaRuns(21, 20)), kNo);
  EXPECT_EQ(measured("C19", gammaRuns(20, 30)).cases.front().value, 0.75);
}

// --- C20

ResultTables flexibleRuns(double gain, const char* configuration, const std::string& ending, int scenes = 3) {
  Table table{{},
              {"block", "configuration", "scene", "settings", "method", "family", "stages", "rtol", "t_end", "outcome",
               "error", "cpu_s"},
              {}};
  const std::pair<const char*, const char*> kPlaces[] = {
      {"rod_with_friction", "slider_crank_flexible"}, {"arm_on_stop", "ancf_stop"}, {"leaf_on_stop", "ancf_leaf_stop"}};
  for (int i = 0; i < scenes; ++i) {
    const auto& [block, scene] = kPlaces[i];
    for (const int stages : {2, 3, 5, 7}) {
      // Three stages are cheapest and do not count; of 5 and 7 the cheaper one does.
      const double cost = stages == 2 ? gain : stages == 3 ? 0.01 : stages == 5 ? 1 : 2;
      for (int digits = 2; digits <= 6; ++digits) {
        for (int time = 1; time <= 10; ++time) {
          table.rows.push_back({block + ending, configuration, scene, "", "radau_iia_" + std::to_string(stages),
                                "radau_iia", std::to_string(stages), fmt::format("1e-{}", digits), std::to_string(time),
                                "success", fmt::format("1e-{}", digits), text(cost * digits)});
        }
      }
    }
  }
  return resultsOf("flexible_contact", "runs", table);
}

TEST(SwitchingClaims, GainOnFlexibleContact) {
  EXPECT_EQ(verdictOf("C20", flexibleRuns(1.5001, "paper", "")), kYes);
  EXPECT_EQ(verdictOf("C20", flexibleRuns(1.499, "paper", "")), kNo);
  EXPECT_EQ(verdictOf("C20", flexibleRuns(1.5001, "embedded", "_located"), Setting::kBest), kYes);
  EXPECT_EQ(verdictOf("C20", flexibleRuns(1.5001, "paper", "", 2)), kUnknown) << "two scenes";
  EXPECT_THROW(measured("C20", flexibleRuns(2, "paper", ""), Setting::kBest), MissingResults);
}

}  // namespace
}  // namespace irk::claims
