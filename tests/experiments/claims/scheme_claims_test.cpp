// Claims about the schemes, on made-up tables on both sides of every threshold.
#include <gtest/gtest.h>

#include "tests/experiments/claim_tables.h"
#include "tests/experiments/support.h"

namespace irk::claims {
namespace {

// --- C1

Verdict orderOf(const char* order, const char* judged = "agrees", const char* stages = "10", int rows = 1) {
  Table orders;
  orders.columns = {"scene", "family", "stages", "verdict", "order"};
  for (int i = 0; i < rows; ++i) {
    for (const auto& scene : kScenes) orders.rows.push_back({scene, "gauss", stages, judged, order});
  }
  orders.rows.push_back({"kaps", "radau_iia", "10", "agrees", "20"});
  return verdict("C1a", resultsOf("order", "orders", orders));
}

TEST(SchemeClaims, ObservedOrder) {
  EXPECT_EQ(orderOf("19.81"), kYes);
  EXPECT_EQ(orderOf("19.79"), kUnknown) << "three cases without one";
  EXPECT_EQ(orderOf("19.79", "agrees", "10", 4), kNo);
  EXPECT_EQ(orderOf("20", "differs"), kYes) << "the observed order counts, whatever theory says";
  EXPECT_EQ(orderOf("nan", "not_measurable", "10", 4), kUnknown);
  EXPECT_EQ(orderOf("20", "agrees", "11"), kUnknown) << "other stages";
  EXPECT_EQ(finding("C1a", kNoResults, Setting::kBest).judged.verdict, Verdict::kDoesNotApply);
}

// Costs of Gauss with `stages` and of Radau IIA with 2 and 5 stages (1 and 2), under several controls.
RunTable stageTable(double cost, const char* stages, const char* scene = "kepler") {
  RunTable runs;
  for (const char* control : {"paper", "predictive"}) {
    const auto add = [&](const char* family, const char* s, double scale) {
      runs.addSeries({{"block", "stages"},
                      {"scene", scene},
                      {"control", control},
                      {"family", family},
                      {"stages", s},
                      {"method", std::string(family) + s}},
                     scale);
    };
    add("gauss", stages, cost);
    add("radau_iia", "2", 1);
    add("radau_iia", "5", 2);
  }
  return runs;
}

TEST(SchemeClaims, CostOfHighOrder) {
  EXPECT_EQ(verdict("C1b", stageTable(1.04, "9").results()), kYes);
  EXPECT_EQ(verdict("C1b", stageTable(1.06, "9").results()), kUnknown);
  EXPECT_EQ(verdict("C1b", stageTable(0.5, "8").results()), kUnknown) << "order 16 is no high one";
  EXPECT_TRUE(
      containsAll(finding("C1b", stageTable(1.06, "9").results()).judged.reason, {"2 cases of 1 scene, needed"}));
}

// --- C2

Verdict fastest(const std::vector<int>& stages) {
  RunTable runs;
  for (std::size_t i = 0; i < kScenes.size(); ++i) {
    for (const char* family : {"radau_iia", "gauss"}) {
      for (const char* control : {"paper", "predictive"}) {
        for (const int s : {2, 5, 6, 7, 10, 13, 14, 20}) {
          runs.addSeries({{"block", "stages"},
                          {"scene", kScenes[i]},
                          {"family", family},
                          {"control", control},
                          {"stages", std::to_string(s)}},
                         1 + std::abs(s - stages[i]));
        }
      }
    }
  }
  return verdict("C2a", runs.results());
}

TEST(SchemeClaims, FastestStages) {
  EXPECT_EQ(fastest({10, 10, 10}), kYes);
  EXPECT_EQ(fastest({7, 7, 7}), kYes);
  EXPECT_EQ(fastest({6, 6, 6}), kNo);
  EXPECT_EQ(fastest({14, 14, 14}), kNo);
  EXPECT_EQ(fastest({13, 13, 13}), kYes);
  EXPECT_EQ(fastest({10, 2, 10}), kOpen);
}

// Ten methods on three scenes; of `newton` of ten, Newton's method is in trouble first, under the given control.
Verdict limit(int newton, const char* other_control = "predictive", const char* other_trouble = "newton_restarts",
              const char* last_error = "1e-10", const char* last_outcome = "success") {
  RunTable runs;
  for (const auto& scene : kScenes) {
    for (int i = 0; i < 10; ++i) {
      for (const char* control : {"paper", "predictive"}) {
        Row row{{"block", "round_off"}, {"scene", scene},          {"method", "radau_iia_" + std::to_string(11 + i)},
                {"control", control},   {"steps_accepted", "100"}, {"rtol", "1e-8"},
                {"error", "1e-9"}};
        runs.addTimes(row);
        row["rtol"] = "1e-12";
        row["error"] = "1e-10";
        const bool is_newton = i < newton;
        row[is_newton && (std::string(control) != other_control || std::string(other_trouble) == "newton_restarts")
                ? "newton_restarts"
                : "steps_rejected_error"] = "20";
        runs.addTimes(row);
        row["rtol"] = "1e-13";
        row["error"] = last_error;
        row["outcome"] = last_outcome;
        runs.addTimes(row);
      }
    }
  }
  return verdict("C2b", runs.results());
}

TEST(SchemeClaims, LimitOfManyStages) {
  EXPECT_EQ(limit(10), kYes);
  EXPECT_EQ(limit(8), kYes) << "80 %";
  EXPECT_EQ(limit(7), kNo);
  EXPECT_EQ(limit(10, "predictive", "steps_rejected_error"), kNo) << "under the paper's control only";
  EXPECT_EQ(limit(10, "predictive", "newton_restarts", "1e-11"), kUnknown) << "the lowest tolerance still helps";
  EXPECT_EQ(limit(0, "predictive", "newton_restarts", "nan", "newton_failed"), kYes);
  EXPECT_EQ(limit(0, "predictive", "newton_restarts", "nan", "max_steps"), kNo);
}

// --- C7

Verdict drift(const char* id, const std::vector<double>& ratios, const char* outcome = "success") {
  RunTable runs;
  for (const auto& scene : kScenes) {
    for (const char* rtol : {"1e-4", "1e-6", "1e-8", "1e-9"}) {
      const char* const ends[] = {"0.1", "1", "10"};
      for (std::size_t i = 0; i < 3; ++i) {
        runs.add({{"block", "drift"},
                  {"scene", scene},
                  {"rtol", rtol},
                  {"t_end", ends[i]},
                  {"outcome", outcome},
                  {"drift", text(2 * ratios[i])},
                  {"error_u", "2"}});
      }
    }
  }
  return verdict(id, runs.results());
}

TEST(SchemeClaims, Drift) {
  EXPECT_EQ(drift("C7a", {0.9, 5, 5}), kYes);
  EXPECT_EQ(drift("C7a", {1.1, 0, 0}), kNo);
  EXPECT_EQ(drift("C7b", {5, 0.9, 5}), kYes);
  EXPECT_EQ(drift("C7b", {0, 1.1, 0}), kNo);
  EXPECT_EQ(drift("C7c", {5, 5, 1}), kYes);
  EXPECT_EQ(drift("C7c", {0, 0, 1.1}), kNo);
  EXPECT_EQ(drift("C7c", {0, 0, 0}, "newton_failed"), kUnknown);
  EXPECT_EQ(drift("C7c", {0, 0, 5}, "drift"), kNo) << "a run that ends because of its drift";
}

// --- C10: computed, not read.

TEST(SchemeClaims, Newmark) {
  const auto found = finding("C10", kNoResults);
  EXPECT_EQ(found.judged.verdict, kYes);
  EXPECT_EQ(found.judged.cases, 12u);
  EXPECT_LT(found.judged.high, 1000);
  EXPECT_GT(found.judged.high, 0) << "two computations do not agree in every bit";
}

// --- C13: of five cases per scene and error, Radau IIA is within 10 % in `good`.

Verdict families(const char* id, double first, double second, double third) {
  const std::vector<double> costs = {first, second, third};
  RunTable runs;
  for (std::size_t i = 0; i < kScenes.size(); ++i) {
    for (const char* family : {"gauss", "radau_iia"}) {
      const bool is_gauss = family[0] == 'g';
      runs.addSeries({{"block", "families"}, {"scene", kScenes[i]}, {"family", family}}, is_gauss ? 1 : costs[i]);
    }
  }
  return verdict(id, runs.results());
}

TEST(SchemeClaims, Families) {
  for (const char* id : {"C13u", "C13v", "C13z"}) {
    EXPECT_EQ(families(id, 1.09, 1.09, 0.5), kYes) << id;
    EXPECT_EQ(families(id, 1.11, 1.11, 2), kNo) << id;
    EXPECT_EQ(families(id, 0.5, 2, 2), kOpen) << id;
  }
}

}  // namespace
}  // namespace irk::claims
