// Newton's contraction, iteration by iteration.
#include "experiments/analyses/contractions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runs/run_table.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

RunSpec kepler() {
  RunSpec spec;
  spec.scene = "kepler";
  spec.method = "radau_iia_3";
  spec.t_end = 1;
  spec.options.newton.kind = NewtonKind::kModified;
  spec.options.tolerances = {.rtol = 1e-6, .atol = 1e-6};
  return spec;
}

// The residual falls by the asked factor, and not before the last iteration.
TEST(Contractions, AreTheReductionsOfTheResidual) {
  RunSpec spec = kepler();
  spec.options.newton.residual_tolerance = 1e-8;
  const auto solves = observedContractions(spec);
  ASSERT_GT(solves.size(), 20u);
  for (const auto& solve : solves) {
    ASSERT_FALSE(solve.empty());
    double reduction = 1;
    for (std::size_t i = 0; i < solve.size(); ++i) {
      EXPECT_GT(reduction, 1e-8) << "iteration " << i + 1 << " of " << solve.size();
      reduction *= solve[i];
    }
    EXPECT_LE(reduction, 1e-8);
  }
}

// Newton's method solves linear equations in one iteration; the second residual is round-off. The test bounds its ratio
// to the first residual. With extrapolated start values the first residual is itself so small, above all in tiny first
// steps and in half steps, that the ratio was 2e-5. These solves therefore start from the accelerations at the step's
// start, which are far from those of the stages: the ratio is 6e-14.
TEST(Contractions, OfALinearSystemAreRoundOff) {
  RunSpec spec = kepler();
  spec.scene = "beam_chain";
  spec.settings = {{"m", "3"}};
  spec.options.newton.residual_tolerance = 1e-3;
  spec.options.predictor = Predictor::kAcceleration;
  spec.options.step.control = StepControl::kFixed;
  spec.options.step.estimate = ErrorEstimate::kNone;
  spec.options.step.h = 0.01;
  const auto solves = observedContractions(spec);
  ASSERT_EQ(solves.size(), 100u);
  for (const auto& solve : solves) {
    ASSERT_EQ(solve.size(), 1u);
    EXPECT_LT(solve.front(), 1e-9);
  }
}

TEST(Contractions, TableHasSolvesOfFourAndMoreIterations) {
  const auto [study, runs] = runsOf(
      "contractions = true\n[[block]]\nscene = \"kepler\"\nt_end = 1\nmethods = \"radau_iia_3\"\n"
      "newton = [\"modified\", \"full\"]\nsolver = \"coupled_dense\"\ntolerances = 1e-3\n");
  const Table table = contractionTable(study, runs);
  ASSERT_FALSE(table.rows.empty());
  for (const auto& row : table.rows) {
    EXPECT_EQ(textAt(table, row, "newton"), "modified");
    const double iterations = numberAt(table, row, "iterations");
    EXPECT_GE(iterations, 4);
    for (int i = 1; i <= 6; ++i) {
      EXPECT_EQ(std::isnan(numberAt(table, row, "c" + std::to_string(i))), i > iterations) << i;
    }
  }
}

}  // namespace
}  // namespace irk
