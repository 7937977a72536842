// The error bar of a run, its outcome, and the run that measures it.
#include "experiments/runs/error_bar.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runs/fields.h"
#include "experiments/runs/run.h"
#include "experiments/runs/setup.h"

namespace irk {
namespace {

RunSpec barSpec(const std::string& text) { return resolved(parseSpec(text + ";error_bar=measured")); }

TEST(RunErrorBar, IsTheErrorInTheMeasureOfTheTables) {
  for (const char* method : {"radau_iia_3", "gauss_4", "lobatto_iiic_4"}) {
    const RunRecord run = execute(barSpec(std::string("scene=kepler;t_end=3;rtol=1e-6;atol=1e-6;method=") + method));
    ASSERT_TRUE(run.succeeded()) << run.detail;
    const double error = std::fmax(run.errors.u, run.errors.v);
    EXPECT_NEAR(run.error_bar.error / error, 1, 0.2) << method;
    EXPECT_EQ(run.error_bar.u.size(), 2);
    EXPECT_EQ(run.error_bar.v.size(), 2);
    EXPECT_FALSE(run.error_bar.component.empty());
    EXPECT_GT(run.error_bar.cpu_s, 0);
  }
}

TEST(RunErrorBar, AboveAThousandTolerancesTheRunIsInaccurate) {
  const std::string growing = "scene=unstable;t_end=1.5;rtol=1e-5;atol=1e-5;settings=";
  const RunRecord bad = execute(barSpec(growing + "L=16"));
  EXPECT_EQ(bad.outcome, "inaccurate");
  EXPECT_NE(bad.detail.find("the error bar is"), std::string::npos) << bad.detail;
  EXPECT_GT(bad.error_bar.tolerances, 1000);
  // The error is known to be large, and stays in the row.
  EXPECT_GT(bad.errors.x, 1e-2);
  const RunRecord unmeasured = execute(resolved(parseSpec(growing + "L=16")));
  EXPECT_EQ(unmeasured.outcome, "success");
  EXPECT_EQ(unmeasured.error_bar.x.size(), 0);
  EXPECT_TRUE(std::isnan(unmeasured.error_bar.error));
  EXPECT_EQ(execute(barSpec(growing + "L=2")).outcome, "success");
}

TEST(RunErrorBar, FixedStepsAreMeasuredAndNotJudged) {
  const RunRecord run = execute(barSpec("scene=kepler;control=fixed;estimate=none;h=0.05;t_end=3;method=radau_iia_2"));
  EXPECT_EQ(run.outcome, "success") << run.detail;
  EXPECT_NEAR(run.error_bar.error / std::fmax(run.errors.u, run.errors.v), 1, 1e-3);
}

TEST(RunErrorBar, ARefinedResultIsThatOfTheSecondIntegration) {
  RunSpec spec = barSpec("scene=kepler;t_end=3;rtol=1e-5;atol=1e-5;method=radau_iia_3");
  const RunRecord measured = execute(spec);
  spec.error_bar = ErrorBarUse::kRefined;
  const RunRecord refined = execute(spec);
  ASSERT_TRUE(refined.succeeded());
  EXPECT_LT(refined.errors.u, 0.3 * measured.errors.u);
  EXPECT_EQ(refined.error_bar.u, measured.error_bar.u);
}

TEST(RunErrorBar, OfAnotherLibrarysResultIsMeasuredAsWell) {
  const RunRecord run = execute(barSpec("scene=van_der_pol;rtol=1e-6;atol=1e-6;method=cvode_bdf"));
  ASSERT_TRUE(run.succeeded()) << run.detail;
  EXPECT_NEAR(run.error_bar.error / run.errors.x, 1, 0.1);
}

TEST(RunErrorBar, IsUnknownIfTheSecondIntegrationRunsOutOfTime) {
  auto spec = barSpec("scene=kepler;rtol=1e-6;atol=1e-6");
  spec.options.step.max_steps = 1'000'000;
  State<double> end = sceneOf<double>(spec).start;
  end.t = 1;
  Solution<double> solution{Outcome::kSuccess, "", end, {}};
  const auto bar =
      measuredErrorBar<double>(spec, sceneOf<double>(spec), solution, {[] { return Outcome::kTimeout; }, {}});
  EXPECT_NE(bar.problem.find("timeout"), std::string::npos) << bar.problem;
  EXPECT_TRUE(std::isnan(bar.tolerances));
  EXPECT_TRUE(doubtOf(bar, spec).empty());
}

// Ten revolutions that pass a planet closely: the second integration is as wrong as the first one. The bars of the last
// three would be 3.1 to 5 times too small. The solution is periodic, so that the error is known.
TEST(RunErrorBar, ALargeOneIsMeasuredAgain) {
  for (const char* close :
       {"e=0.99;rtol=1e-2;atol=1e-2;method=lobatto_iiics_9",
        "e=0.99;rtol=1e-2;atol=1e-3;configuration=embedded;method=lobatto_iiic_6;control=hotint;predictor=previous",
        "e=0.9;rtol=2e-3;atol=2e-3;configuration=variable;method=radau_ia",
        "e=0.99;rtol=1e-2;atol=1e-2;configuration=variable;method=radau_iia",
        "e=0.99;rtol=2e-3;atol=2e-3;configuration=variable;method=radau_ia"}) {
    const RunRecord run = execute(barSpec(std::string("scene=kepler;settings=") + close));
    ASSERT_EQ(run.error_bar.u.size(), 2) << run.detail;
    const auto exact = sceneOf<double>(run.spec).exact(run.spec.t_end);
    for (Index i = 0; i < 2; ++i) {
      const double bar = run.error_bar.u[i], error = std::abs(run.u[i] - exact.u[i]);
      EXPECT_LE(error, 3 * bar) << close << " u" << i;
    }
  }
}

// There is no solution beyond t = 0.5.
TEST(RunErrorBar, NamesTheComponentAtWhichTheSecondIntegrationFails) {
  const auto spec = barSpec("scene=solution_end;rtol=1e-6;atol=1e-6");
  State<double> end = sceneOf<double>(spec).start;
  end.t = 0.6;
  Solution<double> solution{Outcome::kSuccess, "", end, {}};
  const auto bar =
      measuredErrorBar<double>(spec, sceneOf<double>(spec), solution, {[] { return Outcome::kSuccess; }, {}});
  EXPECT_NE(bar.problem.find("largest error in y"), std::string::npos) << bar.problem;
  EXPECT_EQ(bar.problem.find('['), std::string::npos) << bar.problem;
}

// The attempts of the run that measures `spec` with these tolerances.
std::int64_t attemptsWith(const RunSpec& spec, const Tolerances& tolerances) {
  RunSpec second = independentSpec(spec);
  second.options.tolerances = tolerances;
  const Counters& counters = execute(second).counters;
  return counters.steps_accepted + counters.steps_rejected_error + counters.steps_rejected_newton;
}

// A limit of steps that the run with a tenth of the tolerance exceeds, and the one with the run's own does not.
TEST(RunErrorBar, IsMeasuredAtTheRunsToleranceWhereAStricterRunFails) {
  auto spec = barSpec("scene=kepler;rtol=1e-6;atol=1e-6;method=radau_iia_5");
  const std::int64_t strict = attemptsWith(spec, independentSpec(spec).options.tolerances);
  const std::int64_t own = attemptsWith(spec, spec.options.tolerances);
  ASSERT_GT(strict, own + 10);
  spec.options.step.max_steps = (own + strict) / 2;
  spec.error_bar = ErrorBarUse::kRefined;
  State<double> end = sceneOf<double>(spec).exact(spec.t_end);
  end.u[0] += 1e-4;
  Solution<double> solution{Outcome::kSuccess, "", end, {}};
  const MeasuringWatch watch{[] { return Outcome::kSuccess; }, {}};
  const auto bar = measuredErrorBar<double>(spec, sceneOf<double>(spec), solution, watch);
  ASSERT_EQ(bar.problem, "");
  EXPECT_EQ(solution.state.u, end.u) << "no stricter integration gives a better result";
  EXPECT_NE(bar.remark.find("own tolerance"), std::string::npos) << bar.remark;
  EXPECT_NE(bar.remark.find("max_steps"), std::string::npos) << bar.remark;
  EXPECT_NEAR(bar.u[0], 1e-4, 1e-5);
  EXPECT_TRUE(doubtOf(bar, spec).empty());
  solution.state.u[0] += 1;
  const auto large = measuredErrorBar<double>(spec, sceneOf<double>(spec), solution, watch);
  EXPECT_FALSE(doubtOf(large, spec).empty()) << "no stricter result takes the place of this one";
  EXPECT_NE(large.remark.find("may be too small"), std::string::npos) << large.remark;
  EXPECT_GT(large.error, 0.1);
  solution.state = end;
  spec.options.step.max_steps = own / 2;
  const auto unknown = measuredErrorBar<double>(spec, sceneOf<double>(spec), solution, watch);
  EXPECT_NE(unknown.problem.find("max_steps"), std::string::npos) << unknown.problem;
  EXPECT_TRUE(std::isnan(unknown.tolerances));
  // Steps that are fixed are measured with a tolerance that has nothing to do with theirs.
  spec.options.step.max_steps = (own + strict) / 2;
  spec.options.step.control = StepControl::kFixed;
  spec.options.step.h = 0.01;
  EXPECT_NE(measuredErrorBar<double>(spec, sceneOf<double>(spec), solution, watch).problem, "");
}

// A component's own tolerance is part of the run's.
TEST(RunErrorBar, IsMeasuredAtTheRunsToleranceOfEachComponent) {
  auto spec = barSpec("scene=kepler;rtol=1e-6;atol=1e-6;method=radau_iia_5;atol_of=q1=1e-3");
  RunSpec own = independentSpec(spec);
  own.options.tolerances = spec.options.tolerances;
  own.atol_of = spec.atol_of;
  const RunRecord less_strict = execute(own);
  ASSERT_TRUE(less_strict.succeeded()) << less_strict.detail;
  const std::int64_t strict = attemptsWith(spec, independentSpec(spec).options.tolerances);
  spec.options.step.max_steps = strict - 1;
  State<double> end = sceneOf<double>(spec).exact(spec.t_end);
  Solution<double> solution{Outcome::kSuccess, "", end, {}};
  const auto bar =
      measuredErrorBar<double>(spec, sceneOf<double>(spec), solution, {[] { return Outcome::kSuccess; }, {}});
  ASSERT_NE(bar.remark.find("own tolerance"), std::string::npos) << bar.remark << bar.problem;
  const double distance = std::abs(end.u[1] - less_strict.u[1]);
  EXPECT_GE(bar.u[1], distance);
  EXPECT_LE(bar.u[1], distance + 1e-12);  // the time that rounding loses
}

TEST(IndependentSpec, IsOfAnotherFamily) {
  auto spec = barSpec("scene=kepler;method=radau_iia_5");
  for (const char* method : {"radau_iia_5", "radau_iia", "mine.txt", "gauss_2/radau.txt", "lobatto_iiic_mine.txt",
                             "gaussian", "cvode_bdf"}) {
    spec.method = method;
    EXPECT_EQ(independentSpec(spec).method, "lobatto_iiic") << method;
  }
  for (const char* method :
       {"radau_ia_5", "gauss_3", "lobatto_iiic_4", "lobatto_iiics_4", "lobatto_iiia", "lobatto_iiid_9"}) {
    spec.method = method;
    EXPECT_EQ(independentSpec(spec).method, "radau_iia") << method;
  }
}

TEST(IndependentSpec, DiffersInAllThatAMethodIsMadeOf) {
  const auto spec = barSpec(
      "scene=slider_crank;configuration=paper;method=radau_iia_5;formulation=index3;rtol=1e-4;atol=1e-5;"
      "atol_of=theta=1e-3;derivatives=difference_central;h_max=0.1");
  const RunSpec second = independentSpec(spec);
  EXPECT_EQ(second.method, "lobatto_iiic");
  EXPECT_EQ(second.options.order, OrderControl::kVariable);
  EXPECT_EQ(second.formulation, Formulation::kIndex2);
  EXPECT_EQ(second.discontinuity, Discontinuity::kLocate);
  EXPECT_EQ(second.options.derivatives, DerivativeSource::kAutomatic);
  EXPECT_EQ(second.options.step.h_max, 0.1);
  EXPECT_DOUBLE_EQ(second.options.tolerances.rtol, 1e-5);
  EXPECT_DOUBLE_EQ(second.options.tolerances.atol, 1e-6);
  EXPECT_DOUBLE_EQ(std::stod(second.atol_of.at("theta")), 1e-4);
  EXPECT_EQ(second.error_bar, ErrorBarUse::kNone);
  auto other = spec;
  other.method = "lobatto_iiic_4";
  other.discontinuity = Discontinuity::kSmooth;
  EXPECT_EQ(independentSpec(other).method, "radau_iia");
  EXPECT_EQ(independentSpec(other).discontinuity, Discontinuity::kSmooth);
}

}  // namespace
}  // namespace irk
