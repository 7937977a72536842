// The sentences that the page says about studies, made from tables with known results.
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

TEST(StudySentences, SmallStepsGiveTheRangeOfShares) {
  const Table runs{{},
                   {"formulation", "newton", "h", "outcome", "error_z", "jacobians", "steps_accepted"},
                   {{"index3", "simplified", "1e-7", "success", "2e-2", "8", "1000"},
                    {"index3", "simplified", "1e-7", "success", "2e-2", "220", "1000"}}};
  EXPECT_NE(smallStepsSentence(runs).find("a new Jacobian in 0.8 to 22 % of the steps"), std::string::npos);
}

TEST(StudySentences, EstimatesCountStepsAboveThem) {
  const Table estimates{
      {}, {"group", "doubling"}, {{"u", "0.5"}, {"u", "1.5"}, {"z", "20"}, {"z", "0.9"}, {"z", "nan"}}};
  EXPECT_EQ(estimateSentence(estimates),
            "Of 4 estimates by step doubling, the true error of the step is larger in 50 %, and more than ten times as "
            "large in 0 % of those of u and 50 % of those of z.");
}

TEST(StudySentences, ScalingNamesCertainSlopesOverTheUnknowns) {
  const Table slopes{{},
                     {"scene", "solver", "storage", "threads", "over", "at", "slope", "confidence"},
                     {{"beam_chain", "schur", "sparse", "1", "n", "radau_iia_5", "0.934", "0.1"},
                      {"beam_chain", "schur", "sparse", "1", "n", "radau_iia_3", "1.02", "0.1"},
                      {"beam_chain", "schur", "dense", "1", "n", "radau_iia_3", "2.8", "0.9"},
                      {"beam_chain", "schur", "sparse", "2", "n", "radau_iia_5", "0.5", "0.1"},
                      {"beam_chain", "schur", "sparse", "1", "s", "n=50", "1.5", "0.1"},
                      {"ancf_pendulum", "schur", "sparse", "1", "n", "radau_iia_5", "nan", "0.1"}}};
  EXPECT_EQ(scalingSentence(slopes),
            "The time of a step grows with n unknowns like n^0.93 to n^1.02 on beam_chain (`schur`, sparse); 1 more "
            "exponents are uncertain by more than 0.5.");
}

TEST(StudySentences, FailuresNameTheFamiliesWithoutACorrectDigit) {
  Table runs{{},
             {"family", "outcome", "error_u", "error_v", "error_x"},
             {{"gauss", "success", "nan", "nan", "0.5"},
              {"gauss", "newton_failed", "nan", "nan", "nan"},
              {"gauss", "success", "nan", "nan", "1e-3"},
              {"gauss", "success", "nan", "nan", "1e-3"},
              {"radau_iia", "success", "1e-3", "nan", "nan"}}};
  EXPECT_EQ(familiesFailSentence(runs),
            "Runs that fail or end without a correct digit: `gauss` 50 % of 4 and `radau_iia` 0 % of 1.");
  runs.rows[0][4] = "1e-3";
  runs.rows[1][1] = "success";
  EXPECT_EQ(familiesFailSentence(runs), "No run fails or ends without a correct digit.");
}

TEST(StudySentences, PhasesNameTheLargestPartOfTheSteps) {
  const std::vector<std::string> columns{"scene",
                                         "solver",
                                         "n",
                                         "share_residual",
                                         "share_jacobian",
                                         "share_factorization",
                                         "share_solve",
                                         "share_update",
                                         "share_step",
                                         "share_start",
                                         "share_filter_factorization",
                                         "share_filter_solve"};
  const Table phases{{},
                     columns,
                     {{"beam", "coupled_dense", "200", "0.1", "0", "0.4", "0", "0", "0", "0.5", "0", "0"},
                      {"beam", "coupled_dense", "30", "0.5", "0", "0.2", "0", "0", "0", "0.3", "0", "0"},
                      {"beam", "coupled_dense", "30", "0.3", "0", "0.2", "0", "0", "0", "0.5", "0", "0"},
                      {"beam", "coupled_dense", "3", "0.1", "0", "0.9", "0", "0", "0", "0", "0", "0"},
                      {"rod", "schur", "40", "0.1", "0", "0", "0.2", "0", "0", "0.1", "0", "0.6"}}};
  EXPECT_EQ(phasesSentence(phases),
            "The part of the steps that takes most time: beam, `coupled_dense`: residual (66 %) at n = 30, "
            "factorization (80 %) at n = 200; rod, `schur`: filter_solve (67 %) at n = 40.");
  EXPECT_EQ(phasesSentence({{}, columns, {}}), "");
}

TEST(StudySentences, EnergyIsComparedByTheMethodThatKeepsItBest) {
  const Table energy{{},
                     {"scene", "method", "summation", "largest"},
                     {{"kepler", "gauss_6", "plain", "3e-14"},
                      {"kepler", "gauss_6", "compensated", "6e-16"},
                      {"kepler", "gauss_6", "plain", "2e-13"},
                      {"kepler", "gauss_5", "plain", "2e-12"},
                      {"kepler", "gauss_5", "compensated", "2e-12"},
                      {"pendulum", "gauss_4", "plain", "1e-12"}}};
  EXPECT_EQ(energySentence(energy),
            "The largest error of the energy, in the unit of the scene, with the method that keeps it best: 6e-16 with "
            "`compensated` and 2e-13 with `plain` on kepler (`gauss_6`); 1e-12 with `plain` on pendulum (`gauss_4`).");
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
