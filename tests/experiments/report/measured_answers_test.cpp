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

}  // namespace
}  // namespace irk::report
