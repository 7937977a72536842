// Claims about Newton's method and its parts, on made-up tables on both sides of every threshold.
#include <gtest/gtest.h>

#include "tests/experiments/claim_tables.h"
#include "tests/experiments/support.h"

namespace irk::claims {
namespace {

// --- C4 and C15b

struct Shares {
  double residual = 0.3, jacobian = 0.3, factorization = 0.2, solve = 0.2;
};

ResultTables phaseTables(const std::vector<Shares>& of_scenes, const char* n = "20", const char* covered = "1") {
  Table phases;
  phases.columns = {"scene",          "configuration",       "n",           "share_residual",
                    "share_jacobian", "share_factorization", "share_solve", "share_step",
                    "step_s",         "factorization_s",     "run_s",       "covered"};
  for (std::size_t i = 0; i < of_scenes.size(); ++i) {
    for (int k = 0; k < 4; ++k) {
      const Shares& s = of_scenes[i];
      // Ten steps of 0.01 s in a run of 1 s.
      phases.rows.push_back({kScenes[i], "paper", n, text(s.residual), text(s.jacobian), text(s.factorization),
                             text(s.solve), "0.1", "0.01", "0.03", "1", covered});
    }
  }
  return resultsOf("phases", "phases", phases);
}

TEST(NewtonClaims, ShareOfEvaluations) {
  const Shares much{0.3, 0.3, 0.2, 0.2}, half{0.25, 0.25, 0.25, 0.25}, little{0.1, 0.1, 0.4, 0.2};
  EXPECT_EQ(verdict("C4", phaseTables({much, much, much})), kYes);
  EXPECT_EQ(verdict("C4", phaseTables({half, half, half})), kNo) << "above, not at, one half";
  EXPECT_EQ(verdict("C4", phaseTables({little, little, little})), kNo);
  EXPECT_EQ(verdict("C4", phaseTables({much, little, much})), kOpen);
  EXPECT_EQ(verdict("C4", phaseTables({much, much, much}, "201")), kUnknown);
  EXPECT_EQ(verdict("C4", phaseTables({much, much, much}, "2")), kUnknown);
  EXPECT_EQ(verdict("C4", phaseTables({much, much, much}, "20", "0.8")), kUnknown) << "parts that do not add up";
  EXPECT_TRUE(containsAll(finding("C4", phaseTables({much, little, much})).judged.remark,
                          {"pendulum never", "slider_crank 20"}));
  EXPECT_EQ(verdict("C4", phaseTables({much, much, much}), Setting::kBest), kUnknown);
}

TEST(NewtonClaims, CostOfAFactorizationIsReported) {
  const auto found = finding("C15b", phaseTables({{}, {}, {}}));
  EXPECT_EQ(found.judged.verdict, Verdict::kReported);
  EXPECT_NEAR(found.judged.value, 0.3, 1e-12) << "0.03 s of a step of 0.1 s";
}

// --- C5

RunTable massTerms(const std::vector<double>& factors) {
  RunTable runs;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    for (const char* jacobian : {"full", "no_mass"}) {
      runs.addSeries({{"block", "mass_terms_crank"}, {"scene", kScenes[i]}, {"jacobian", jacobian}},
                     jacobian[0] == 'f' ? 1 : factors[i]);
    }
  }
  return runs;
}

TEST(NewtonClaims, MassDerivatives) {
  EXPECT_EQ(verdict("C5a", massTerms({1.09, 1.05, 1}).results()), kYes);
  EXPECT_EQ(verdict("C5a", massTerms({1.11, 1.2, 1.3}).results()), kNo);
  EXPECT_EQ(verdict("C5a", massTerms({1, 1, 1.3}).results()), kOpen);
  EXPECT_EQ(verdict("C5b", massTerms({0.99, 0.9, 1}).results()), kYes);
  EXPECT_EQ(verdict("C5b", massTerms({1.01, 1.1, 1.2}).results()), kNo);
  EXPECT_EQ(verdict("C5b", massTerms({0.9, 0.9, 1.2}).results()), kOpen);
  EXPECT_EQ(verdict("C5b", massTerms({1, 1}).results()), kUnknown) << "two scenes";
}

// --- C6

Verdict digits(const char* id, const char* formulation, const std::vector<std::string>& tiny,
               const char* scaling = "on") {
  RunTable runs;
  for (std::size_t i = 0; i < kScenes.size(); ++i) {
    for (const char* method : {"radau_iia_2", "radau_iia_3", "radau_iia_4", "radau_iia_5"}) {
      Row row{{"scene", kScenes[i]}, {"method", method}, {"formulation", formulation}, {"scaling", scaling}};
      row["block"] = "usual_steps";
      row["error_z"] = "1e-10";
      runs.addTimes(row);
      row["block"] = "tiny_steps";
      row["rtol"] = "1e-7";
      row["error_z"] = tiny[i];
      runs.addTimes(row);
    }
  }
  return verdict(id, runs.results());
}

TEST(NewtonClaims, DigitsLost) {
  EXPECT_EQ(digits("C6b", "index3", {"1.1e-6", "1e-5", "1e-4"}), kYes);
  EXPECT_EQ(digits("C6b", "index3", {"0.9e-6", "1e-7", "1e-8"}), kNo);
  EXPECT_EQ(digits("C6b", "index3", {"1e-4", "1e-4", "1e-9"}), kOpen);
  EXPECT_EQ(digits("C6b", "index2", {"1e-4", "1e-4", "1e-4"}), kUnknown);
  EXPECT_EQ(digits("C6c", "index2", {"0.9e-9", "1e-10", "1e-12"}), kYes);
  EXPECT_EQ(digits("C6c", "index2", {"1.1e-9", "1e-8", "1e-7"}), kNo);
  EXPECT_EQ(digits("C6c", "index2", {"1e-10", "1e-10", "1e-10"}, "off"), kUnknown);
}

// One hundred steps each; the numbers of iterations at the tiny steps, by scene.
RunTable tinySteps(const std::vector<double>& iterations, const char* formulation = "index3",
                   const char* usual_outcome = "success") {
  RunTable runs;
  for (std::size_t i = 0; i < kScenes.size(); ++i) {
    for (const char* tolerance : {"1e-2", "1e-4", "1e-6", "1e-8"}) {
      Row row{{"scene", kScenes[i]}, {"formulation", formulation}, {"steps_accepted", "100"}};
      row["residual_tolerance"] = tolerance;
      row["block"] = "rule_usual";
      row["outcome"] = usual_outcome;
      row["newton_iterations"] = "200";
      runs.add(row);
      row["block"] = "rule_tiny";
      row["outcome"] = iterations[i] < 1e4 ? "success" : "newton_failed";
      row["newton_iterations"] = text(iterations[i]);
      runs.add(row);
    }
  }
  return runs;
}

TEST(NewtonClaims, IterationsAtTinySteps) {
  constexpr double kFails = 1e9;
  const auto of = [](const std::vector<double>& iterations) { return tinySteps(iterations).results(); };
  EXPECT_EQ(verdict("C6a", of({401, 500, 600})), kYes) << "four per step, and two at 1e-4";
  EXPECT_EQ(verdict("C6a", of({399, 300, 200})), kNo);
  EXPECT_EQ(verdict("C6a", of({200, 500, 500})), kOpen);
  EXPECT_EQ(verdict("C6a", of({kFails, kFails, kFails})), kYes) << "no convergence is the worst one";
  EXPECT_TRUE(containsAll(finding("C6a", of({kFails, 500, 500})).judged.remark, {"4 of 12 runs fail"}));
  EXPECT_EQ(verdict("C6a", tinySteps({500, 500, 500}, "index3", "newton_failed").results()), kUnknown)
      << "what fails at 1e-4, too, says nothing of the step";
  EXPECT_EQ(verdict("C6a", tinySteps({500, 500, 500}, "index2").results()), kUnknown);
  EXPECT_TRUE(containsAll(finding("C6a", tinySteps({500, 500, 500}, "index2").results()).judged.remark,
                          {"In index 2", "2.5 times"}));
  EXPECT_EQ(verdict("C6a", kNoResults), kUnknown);
}

// --- C11

ResultTables kForm(const std::string& mass_factorizations) {
  RunTable runs;
  for (const auto& scene : kScenes) {
    for (int i = 0; i < 4; ++i) {
      runs.add({{"scene", scene}, {"rtol", text(i + 1)}, {"mass_factorizations", mass_factorizations}});
    }
    runs.add({{"scene", scene}, {"formulation", "first_order"}, {"mass_factorizations", "99"}});
  }
  return resultsOf("k_form", "runs", runs.table());
}

TEST(NewtonClaims, MassIsNotFactorized) {
  EXPECT_EQ(verdict("C11a", kForm("0")), kYes);
  EXPECT_EQ(verdict("C11a", kForm("1")), kNo);
  EXPECT_TRUE(containsAll(finding("C11a", kForm("3")).judged.remark, {"pendulum 3", "slider_crank 3"}));
}

// The costs of the K-form and of both first-order forms.
ResultTables massForms(const std::vector<double>& k_form, double per_point, double per_step) {
  RunTable runs;
  for (std::size_t i = 0; i < kScenes.size(); ++i) {
    Row row{{"block", "mass_form_crank"}, {"scene", kScenes[i]}};
    const std::pair<const char*, double> forms[] = {
        {"index2", k_form[i]}, {"first_order", per_point}, {"first_order_per_step", per_step}};
    for (const auto& [formulation, cost] : forms) {
      row["formulation"] = formulation;
      runs.addSeries(row, cost);
    }
  }
  return runs.results();
}

TEST(NewtonClaims, KFormAgainstTheBestFirstOrderForm) {
  EXPECT_EQ(verdict("C11b", massForms({0.9, 0.99, 0.9}, 1, 2)), kYes);
  EXPECT_EQ(verdict("C11b", massForms({0.9, 0.99, 0.9}, 2, 1)), kYes);
  EXPECT_EQ(verdict("C11b", massForms({1.01, 1.1, 1.2}, 1, 2)), kNo) << "once per evaluation is the best";
  EXPECT_EQ(verdict("C11b", massForms({1.01, 1.1, 1.2}, 2, 1)), kNo) << "once per step is the best";
  EXPECT_EQ(verdict("C11b", massForms({0.5, 0.5, 2}, 1, 2)), kOpen);
  EXPECT_TRUE(containsAll(finding("C11b", massForms({1, 1, 1}, 2, 1)).judged.remark, {"In 30 of 30 cases"}));
  EXPECT_EQ(verdict("C11b", kForm("0")), kUnknown) << "the study claims has its runs";
}

// --- C12: the best rule of one half of the scenes is judged on the other.

Verdict rule(double papers, const std::vector<double>& others) {
  const std::vector<std::string> scenes = {"a", "b", "c", "d"};
  RunTable runs;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Row row{{"block", "newton_rule"}, {"scene", scenes[i]}};
    runs.addSeries(row, papers);
    Row other = row;
    other["contractivity_limit"] = "0.3";
    runs.addSeries(other, others[i]);
  }
  return verdict("C12", runs.results());
}

TEST(NewtonClaims, RuleOfTheModifiedMethod) {
  EXPECT_EQ(rule(1, {1, 1, 1, 1}), kYes);
  EXPECT_EQ(rule(1.09, {1, 1, 1, 1}), kYes);
  EXPECT_EQ(rule(1.11, {1, 1, 1, 1}), kNo);
  EXPECT_EQ(rule(1, {2, 2, 2, 2}), kYes) << "the paper's is the best";
  // 0.3 is the best on a and c, and dear on b and d, where it is judged.
  EXPECT_EQ(rule(1, {0.5, 4, 0.5, 4}), kYes);
  EXPECT_EQ(rule(1, {0.5, 0.5, 0.5, 4}), kOpen);
}

// --- C15a

ResultTables reuse(const std::vector<double>& factors, Setting setting = Setting::kPaper) {
  const bool paper = setting == Setting::kPaper;
  RunTable runs;
  for (std::size_t i = 0; i < kScenes.size(); ++i) {
    Row row{{"block", paper ? "step_reuse" : "step_reuse_best"}, {"scene", kScenes[i]}};
    row["configuration"] = paper ? "paper" : "embedded";
    row["newton"] = paper ? "modified_each_step" : "broyden_each_step";
    runs.addSeries(row, 1);
    row["newton"] = paper ? "modified_step_change" : "broyden_step_change";
    runs.addSeries(row, factors[i]);
    row["newton"] = "modified";  // keeps its Jacobian by contraction: has no say
    runs.addSeries(row, 0.1);
  }
  return runs.results();
}

TEST(NewtonClaims, ReuseAcrossChangesOfStep) {
  for (const auto setting : {Setting::kPaper, Setting::kBest}) {
    EXPECT_EQ(verdict("C15a", reuse({0.99, 0.9, 0.8}, setting), setting), kYes);
    EXPECT_EQ(verdict("C15a", reuse({1.01, 1.1, 1.2}, setting), setting), kNo);
    EXPECT_EQ(verdict("C15a", reuse({0.9, 0.9, 1.2}, setting), setting), kOpen);
    EXPECT_EQ(verdict("C15a", kNoResults, setting), kUnknown);
  }
  EXPECT_TRUE(containsAll(finding("C15a", reuse({0.5, 0.5, 0.5})).judged.remark, {"Jacobians: 0.5 times"}));
  EXPECT_EQ(verdict("C15a", reuse({0.9, 0.9, 0.9}), Setting::kBest), kUnknown) << "runs of the other setting";
}

}  // namespace
}  // namespace irk::claims
