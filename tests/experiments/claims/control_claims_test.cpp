// Claims about error estimates, step control and switches, on made-up tables on both sides of every threshold.
#include <gtest/gtest.h>

#include "tests/experiments/claim_tables.h"
#include "tests/experiments/support.h"

namespace irk::claims {
namespace {

// --- C3a

Verdict doubling(const std::vector<double>& factors, const char* doubled_steps = "100", const char* rejected = "0") {
  RunTable runs;
  for (std::size_t i = 0; i < kScenes.size(); ++i) {
    for (const char* method : {"radau_iia_2", "radau_iia_3", "radau_iia_5", "radau_iia_7"}) {
      Row row{{"scene", kScenes[i]}, {"method", method}};
      row["block"] = "plain_steps";
      row["residuals"] = "1000";
      row["steps_accepted"] = "200";
      runs.add(row);
      row["block"] = "doubled_steps";
      row["residuals"] = text(1000 * factors[i]);
      row["steps_accepted"] = doubled_steps;
      row["steps_rejected_error"] = rejected;
      runs.add(row);
    }
  }
  return verdict("C3a", runs.results());
}

TEST(ControlClaims, CostOfDoubling) {
  EXPECT_EQ(doubling({1.36, 1.5, 1.64}), kYes);
  EXPECT_EQ(doubling({1.34, 1.3, 1.2}), kNo);
  EXPECT_EQ(doubling({1.66, 1.7, 1.8}), kNo);
  EXPECT_EQ(doubling({1.5, 1.5, 2}), kOpen);
  EXPECT_EQ(doubling({1.5, 1.5, 1.5}, "101"), kUnknown) << "other steps";
  EXPECT_EQ(doubling({1.5, 1.5, 1.5}, "100", "1"), kUnknown) << "a rejected one";
}

// --- C8: 3 `bdf` steps per restart beside `radau` of Radau IIA; the smooth part costs BDF nothing and Radau IIA much.

ResultTables restarts(const std::vector<double>& bdf, const char* outcome = "success", double radau = 3,
                      bool bdf_switches = true) {
  RunTable runs;
  for (std::size_t i = 0; i < kScenes.size(); ++i) {
    for (const char* rtol : {"1e-4", "1e-6", "1e-7", "1e-8"}) {
      for (const int k : {0, 5, 20, 49}) {
        const auto add = [&](const char* method, double smooth, double each, bool switches = true) {
          const auto cost = text(smooth + each * k);
          runs.add({{"block", "restarts"},
                    {"scene", kScenes[i]},
                    {"rtol", rtol},
                    {"method", method},
                    {"configuration", "default"},
                    {"outcome", outcome},
                    {"located_events", std::to_string(switches ? k : 5)},
                    {"steps_accepted", cost},
                    {"cpu_s", cost},
                    {"residuals", text(0.25 * (smooth + each * k))},
                    {"dual_residuals", text(0.75 * (smooth + each * k))}});
        };
        add("radau_iia_3", 1000, radau);
        add("cvode_bdf", 1, 3 * bdf[i], bdf_switches);
      }
    }
  }
  return runs.results();
}

TEST(ControlClaims, Restarts) {
  for (const char* id : {"C8a", "C8b"}) {
    const auto best = [&](const ResultTables& tables) { return verdict(id, tables, Setting::kBest); };
    EXPECT_EQ(best(restarts({2.1, 5, 9})), kYes);
    EXPECT_EQ(best(restarts({1.9, 1, 1})), kNo);
    EXPECT_EQ(best(restarts({1, 5, 5})), kOpen);
    EXPECT_EQ(best(restarts({5, 5, 5}, "max_steps")), kUnknown);
    EXPECT_EQ(best(restarts({5, 5, 5}, "success", 0)), kUnknown) << "no ratio to a cost of zero";
    EXPECT_EQ(best(restarts({5, 5, 5}, "success", -0.5)), kUnknown) << "nor to one that falls";
    EXPECT_EQ(verdict(id, restarts({5, 5, 5})), Verdict::kDoesNotApply);
    const auto equal = finding(id, restarts({5, 5, 5}, "success", 3, false), Setting::kBest);
    EXPECT_EQ(equal.measured.cases.size(), 0U) << "BDF always has as many switches: it has no slope";
  }
  const auto residuals = finding("C8c", restarts({4, 4, 4}), Setting::kBest);
  EXPECT_EQ(residuals.judged.verdict, Verdict::kReported);
  EXPECT_NEAR(residuals.judged.value, 4, 1e-9) << "plain and dual ones";
}

// --- C9

Verdict gain(const std::vector<double>& factors) {
  RunTable runs;
  for (std::size_t i = 0; i < kScenes.size(); ++i) {
    const auto add = [&](const char* family, const char* stages, double scale) {
      runs.addSeries({{"block", "stages"}, {"scene", kScenes[i]}, {"family", family}, {"stages", stages}}, scale);
    };
    add("radau_iia", "2", factors[i]);
    add("radau_iia", "3", 1e-3);  // neither two nor five
    add("radau_iia", "5", 3);
    add("radau_iia", "9", 1);
    add("gauss", "9", 1e-3);
  }
  return verdict("C9a", runs.results());
}

TEST(ControlClaims, GainBetweenSwitches) {
  EXPECT_EQ(gain({1.6, 2, 3}), kYes);
  EXPECT_EQ(gain({1.4, 1, 1}), kNo);
  EXPECT_EQ(gain({1, 2, 2}), kOpen);
  EXPECT_EQ(verdict("C9b", kNoResults), kUnknown);
}

// --- C14

Verdict norms(const std::vector<double>& absolute, double mixed, double relative) {
  RunTable runs;
  for (std::size_t i = 0; i < kScenes.size(); ++i) {
    runs.addSeries({{"block", "norm_absolute"}, {"scene", kScenes[i]}}, absolute[i]);
    runs.addSeries({{"block", "norm_mixed"}, {"scene", kScenes[i]}, {"norm", "mixed"}}, mixed);
    runs.addSeries({{"block", "norm_relative"}, {"scene", kScenes[i]}, {"norm", "mixed"}}, relative);
  }
  return verdict("C14", runs.results());
}

TEST(ControlClaims, AbsoluteTolerances) {
  EXPECT_EQ(norms({1, 0.9, 0.8}, 1.01, 2), kYes);
  EXPECT_EQ(norms({1.02, 1.1, 1.2}, 1.01, 2), kNo);
  EXPECT_EQ(norms({1, 1, 1}, 2, 0.9), kNo) << "relative ones are cheaper";
  EXPECT_EQ(norms({0.9, 0.9, 1.5}, 1, 1), kOpen);
}

}  // namespace
}  // namespace irk::claims
