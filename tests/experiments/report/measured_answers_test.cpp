// Sentences of studies, from tables that decide what they say.
#include "experiments/report/answers/measured_answers.h"

#include <gtest/gtest.h>

namespace irk::report {
namespace {

TEST(StudySentences, SmallStepsCompareAtTheSmallestCommonStep) {
  const Table runs{{},
                   {"formulation", "newton", "h", "outcome", "error_z", "jacobians", "steps_accepted"},
                   {{"index3", "simplified", "1e-4", "success", "1e-9", "1", "10"},
                    {"index2", "simplified", "1e-4", "success", "1e-16", "1", "10"},
                    {"index3", "simplified", "1e-7", "success", "2e-2", "250", "1000"},
                    {"index3", "modified", "1e-7", "success", "4e-2", "1", "1000"},
                    {"index2", "simplified", "1e-7", "success", "3e-16", "1", "1000"},
                    {"index3", "simplified", "1e-8", "newton_failed", "nan", "9", "9"},
                    {"index2", "simplified", "1e-8", "success", "5e-5", "9", "9"}}};
  EXPECT_EQ(smallStepsSentence(runs),
            "At steps of 1e-7 the multiplier has a median error of 3e-16 with `index2` and 3e-02 with `index3`; "
            "simplified Newton needs a new Jacobian in 0.1 % of the steps with `index2` and 25 % of the steps with "
            "`index3`.");
  EXPECT_EQ(smallStepsSentence({{}, runs.columns, {}}), "");
}

TEST(StudySentences, EstimatesCountStepsAboveThem) {
  const Table estimates{{}, {"doubling"}, {{"0.5"}, {"1.5"}, {"20"}, {"0.9"}, {"nan"}}};
  EXPECT_EQ(estimateSentence(estimates),
            "Of 4 estimates by step doubling, the true error of the step is larger in 50 %, and more than ten times as "
            "large in 25 %.");
}

TEST(StudySentences, ScalingNamesSlopesOverTheUnknowns) {
  const Table slopes{{},
                     {"scene", "solver", "storage", "threads", "over", "at", "slope"},
                     {{"beam_chain", "schur", "sparse", "1", "n", "radau_iia_5", "0.934"},
                      {"beam_chain", "schur", "sparse", "2", "n", "radau_iia_5", "0.5"},
                      {"beam_chain", "schur", "sparse", "1", "s", "n=50", "1.5"},
                      {"ancf_pendulum", "schur", "sparse", "1", "n", "radau_iia_5", "nan"}}};
  EXPECT_EQ(scalingSentence(slopes),
            "The time of a step grows with n unknowns like n^0.93 on beam_chain (`schur`, sparse, `radau_iia_5`).");
}

TEST(StudySentences, FailuresNameTheFamilies) {
  Table runs{{}, {"family", "outcome"}, {{"gauss", "success"}, {"gauss", "newton_failed"}, {"radau_iia", "success"}}};
  EXPECT_EQ(familiesFailSentence(runs),
            "`gauss` fails most often, in 1 of 2 runs; `radau_iia` least often, in 0 of 1.");
  runs.rows[1][1] = "success";
  EXPECT_EQ(familiesFailSentence(runs), "No run fails.");
}

TEST(StudySentences, PhasesNameTheLargestPartOfSmallAndLargeSystems) {
  const std::vector<std::string> columns{
      "solver",       "n",          "share_residual", "share_jacobian", "share_factorization", "share_solve",
      "share_update", "share_step", "share_start"};
  const Table phases{{},
                     columns,
                     {{"coupled_dense", "200", "0.1", "0", "0.9", "0", "0", "0", "0"},
                      {"coupled_dense", "3", "0.5", "0", "0.2", "0", "0", "0", "0.3"},
                      {"coupled_dense", "3", "0.3", "0", "0.2", "0", "0", "0", "0.5"},
                      {"coupled_dense", "3", "0.6", "0", "0.2", "0", "0", "0", "0.2"},
                      {"schur", "3", "0.1", "0", "0.2", "0.6", "0", "0", "0.1"}}};
  EXPECT_EQ(
      phasesSentence(phases),
      "The part with the largest median share: `coupled_dense` residual (50 %) at n = 3, factorization (90 %) at n = "
      "200; `schur` solve (60 %) at n = 3.");
  EXPECT_EQ(phasesSentence({{}, columns, {}}), "");
}

TEST(StudySentences, EnergyIsComparedBySummation) {
  const Table energy{{},
                     {"scene", "summation", "largest"},
                     {{"kepler", "plain", "3e-14"},
                      {"kepler", "compensated", "6e-16"},
                      {"kepler", "plain", "2e-13"},
                      {"pendulum", "plain", "1e-12"}}};
  EXPECT_EQ(
      energySentence(energy),
      "The largest relative error of the energy: 6e-16 with `compensated` and 2e-13 with `plain` on kepler; 1e-12 with "
      "`plain` on pendulum.");
}

TEST(StudySentences, StepsCountTriesOfSuccessfulRuns) {
  const Table runs{{},
                   {"method", "outcome", "steps_accepted", "steps_rejected_error", "steps_rejected_newton"},
                   {{"radau_iia_2", "success", "900", "50", "50"},
                    {"radau_iia_2", "newton_failed", "5", "9", "9"},
                    {"radau_iia_5", "success", "30", "5", "5"}}};
  EXPECT_EQ(stepsSentence(runs),
            "Steps, as a median: 900 with `radau_iia_2`, 10 % of all tries rejected; 30 with `radau_iia_5`, 25 % of "
            "all tries "
            "rejected.");
}

}  // namespace
}  // namespace irk::report
