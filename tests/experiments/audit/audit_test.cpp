#include <fmt/format.h>
#include <gtest/gtest.h>
#include <cmath>
#include <csignal>
#include <iterator>
#include <set>

#include "experiments/audit/audit.h"
#include "experiments/audit/coverage.h"
#include "experiments/commands/commands.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/final_states.h"
#include "experiments/runs/run_table.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/audit/audited.h"
#include "tests/experiments/study_runs.h"

namespace irk::audit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

Evidence evidence(double error, double tolerance) {
  return {.success = true, .tolerance = tolerance, .error = error, .accuracy = 1e-12, .kappa = 10};
}

TEST(AuditJudge, DistinguishesAllJudgements) {
  EXPECT_EQ(judge(evidence(1.0000005e-3, 1e-6)), Judgement::kRight);
  EXPECT_EQ(judge(evidence(1.0000015e-3, 1e-6)), Judgement::kWrong) << "1000 tol + 1e-9";
  EXPECT_EQ(judge(evidence(1.05e-9, 1e-13)), Judgement::kRight);
  EXPECT_EQ(judge(evidence(1.15e-9, 1e-13)), Judgement::kWrong) << "1e-10 + 1e-9";
  EXPECT_EQ(judge(evidence(kInfinity, 1e-2)), Judgement::kWrong);
  EXPECT_EQ(judge(evidence(kUnknown, 1e-2)), Judgement::kUnjudged);

  Evidence e = evidence(1, 1e-6);
  e.success = false;
  EXPECT_EQ(judge(e), Judgement::kFailed);
  e.accuracy = e.kappa = kUnknown;
  EXPECT_EQ(judge(e), Judgement::kFailed) << "a failure needs no reference";

  e = evidence(1, 1e-6);
  e.kappa = 1001;
  EXPECT_EQ(judge(e), Judgement::kIllConditioned);
  e.success = false;
  EXPECT_EQ(judge(e), Judgement::kIllConditioned) << "whatever the outcome";
  e = evidence(1, 1e-6);
  e.kappa = 999;
  EXPECT_EQ(judge(e), Judgement::kWrong);
  e.kappa = kInfinity;
  EXPECT_EQ(judge(e), Judgement::kIllConditioned);
  e = evidence(0, 1e-13);
  e.kappa = 440;  // * 2.2e-16 = 0.98e-13
  EXPECT_EQ(judge(e), Judgement::kRight);
  e.kappa = 460;
  EXPECT_EQ(judge(e), Judgement::kIllConditioned) << "round-off alone";

  e = evidence(0, 1e-6);
  e.accuracy = 0.9e-4;
  EXPECT_EQ(judge(e), Judgement::kRight);
  e.accuracy = 1.1e-4;
  EXPECT_EQ(judge(e), Judgement::kUnjudged) << "a tenth of the bar";
  e = evidence(0, 1e-6);
  e.kappa = kUnknown;
  EXPECT_EQ(judge(e), Judgement::kRight) << "no closed form tells kappa";
  e.error = 1;
  EXPECT_EQ(judge(e), Judgement::kWrong);
}

Vec<double> vec(std::initializer_list<double> values) {
  Vec<double> y(static_cast<Index>(values.size()));
  std::copy(values.begin(), values.end(), y.begin());
  return y;
}

TEST(AuditJudge, MeasuresByMagnitudeOrScale) {
  const auto scale = vec({10, 0.1});
  EXPECT_DOUBLE_EQ(scaledDifference(vec({3, 5, 7}), vec({1, 5, 7}), scale, 0, 3), 0.2);
  EXPECT_DOUBLE_EQ(scaledDifference(vec({1, 6, 7}), vec({1, 5, 7}), scale, 0, 3), 0.2);
  EXPECT_DOUBLE_EQ(scaledDifference(vec({1, 5, 0.2}), vec({1, 5, 0.1}), scale, 0, 3), 0.1);
  EXPECT_EQ(scaledDifference(vec({1, 5, 9}), vec({1, 5, 7}), scale, 0, 2), 0);
  EXPECT_EQ(scaledDifference(vec({1, 5}), vec({1, kUnknown}), scale, 0, 2), 0);
  EXPECT_TRUE(std::isnan(scaledDifference(vec({1}), vec({kUnknown}), scale, 0, 1)));
  EXPECT_EQ(scaledDifference(vec({kUnknown}), vec({1}), scale, 0, 1), kInfinity);
}

Answer answer(const std::string& scene, const std::string& settings, bool smooth = false,
              double t_end = std::numeric_limits<double>::quiet_NaN()) {
  RunSpec spec;
  spec.scene = scene;
  spec.t_end = t_end;
  findField("settings").set(spec, settings);
  if (smooth) spec.discontinuity = Discontinuity::kSmooth;
  return answerOf(questionOf(resolved(spec)), nullptr);
}

TEST(AuditReference, IsExactOrFromAFileOrComputed) {
  const auto exact = answer("pendulum", "g=5");
  EXPECT_EQ(exact.source, "exact");
  EXPECT_EQ(exact.accuracy, 0);
  EXPECT_EQ(exact.remark, "");
  EXPECT_EQ(exact.other.size(), 0);

  const auto file = answer("slider_crank", "torque_off_at=0.5");
  EXPECT_EQ(file.source, "file");
  EXPECT_LT(file.accuracy, 1e-14);
  EXPECT_EQ(file.remark, "");

  const auto computed = answer("slider_crank", "torque_off_at=0.6");
  EXPECT_EQ(computed.source, "computed");
  EXPECT_LT(computed.accuracy, 1e-9);
  EXPECT_GT(computed.accuracy, 0) << "of two methods";
  EXPECT_EQ(&computed.stateFor("gauss"), &computed.state);
  EXPECT_EQ(&computed.stateFor("radau_ia"), &computed.other) << "never by its own family";
  EXPECT_EQ(&computed.stateFor("radau_iia"), &computed.other);
  EXPECT_GT((computed.state - file.state).norm(), 1e-3);

  const auto smooth = answer("slider_crank", "torque_off_at=0.5", true);
  EXPECT_EQ(smooth.source, "computed") << "another problem";
  EXPECT_GT((smooth.state - file.state).norm(), 1e-8);
}

// The value is that of radau_iia_9 in 50 digits with a tolerance of 1e-25. In double precision the closed form loses
// eleven digits: the controller is unstable, and so is its sum of exponentials.
TEST(AuditReference, EvaluatesClosedFormsInFiftyDigits) {
  const auto unstable = answer("sampled_control", "Kd=17.2 Kp=68.2 Ts=0.136 c=20.7 d=1.88 m=0.272 r=0.778");
  EXPECT_EQ(unstable.source, "exact");
  EXPECT_NEAR(unstable.state[0] / 9798.6285682219387714370689, 1, 1e-15);
  EXPECT_NEAR(unstable.state[1] / -1345367.1411197789741827118, 1, 1e-15);
}

// A success where there is no solution is wrong, whatever its value.
TEST(AuditReference, SaysWhereThereIsNoSolution) {
  for (const auto& [scene, end] : {std::pair("solution_end", 0.5), {"blow_up", 1}, {"bead_cross", 0.7}}) {
    const auto before = answer(scene, "", false, 0.9 * end), behind = answer(scene, "", false, 1.1 * end);
    EXPECT_EQ(before.remark, "") << scene;
    EXPECT_EQ(behind.remark, "no solution at this time") << scene;
    EXPECT_EQ(behind.source, "exact") << scene;
    EXPECT_EQ(scaledDifference(before.state, behind.state, {}, 0, behind.state.size()), kInfinity);
    const auto known = makeScene<double>(scene);
    State<double> state = known.start;
    state.t = 1.1 * end;
    EXPECT_EQ(irk::errorsOf(known, {}, state).all, kInfinity) << scene;
    const Evidence success{true, 1e-2, kInfinity, behind.accuracy, behind.kappa};
    EXPECT_EQ(judge(success), Judgement::kWrong) << scene;
  }
}

// The value is that of another program. Double precision does not suffice: errors grow by a factor of 2e6.
TEST(AuditReference, TakesFiftyDigitsForChaos) {
  const auto chaos = answer("lorenz", "", false, 30);
  EXPECT_EQ(chaos.source, "computed");
  EXPECT_EQ(chaos.remark, "in 50 digits");
  EXPECT_LT(chaos.accuracy, 1e-10);
  EXPECT_NEAR(chaos.state[0], -3.8926373373794854, 1e-9);
  EXPECT_NEAR(chaos.state[1], .27401981621737415, 1e-9);
  EXPECT_NEAR(chaos.state[2], 27.866107798922574, 1e-9);
  EXPECT_GT(chaos.kappa, 1e5);
  EXPECT_LT(chaos.kappa, 1e8);
}

TEST(AuditReference, KnowsTheConditioningFromTheClosedForm) {
  // The distance from cos t grows by e^L.
  EXPECT_NEAR(answer("unstable", "L=5").kappa, std::exp(5), 1e-5);
  EXPECT_GT(answer("unstable", "L=20").kappa, kLargestKappa);
  EXPECT_NEAR(answer("unstable", "L=20", false, 0.25).kappa, std::exp(5), 1e-5);
  // y0 = 1 decays by e^-2, beside y(2) = e^-2 + 10 e^-1.
  EXPECT_NEAR(answer("input_kink", "").kappa, std::exp(-2) / (std::exp(-2) + 10 * std::exp(-1)), 1e-8);
  // y0 / (1 - y0 t) at y0 = 1, t = 0.8, where it is 5: dy / dy0 = 25, each relative to its magnitude.
  EXPECT_NEAR(answer("blow_up", "").kappa, 5, 1e-6);
  // Nothing moves the start of y' = lambda y.
  EXPECT_TRUE(std::isnan(answer("dahlquist", "lambda_re=20 lambda_im=0").kappa));
}

TEST(AuditReference, KnowsTheConditioningFromPerturbedRuns) {
  // A fourth-order method with 10 000 steps gives 681.8 for all signs positive.
  const auto chaos = answer("lorenz", "", false, 20);
  EXPECT_GT(chaos.kappa, 600);
  EXPECT_LT(chaos.kappa, 2000);
  const auto start = answer("lorenz", "", false, 0.01);
  EXPECT_GT(start.kappa, 0.5);
  EXPECT_LT(start.kappa, 2) << "errors grow by less than e^(20 t)";
  // Hidden constraints forbid every step from a perturbed start.
  EXPECT_LT(answer("pump", "", false, 40).kappa, kLargestKappa);
}

// A component's own tolerance counts, with the magnitude of the reference, not of the result.
TEST(AuditCoverage, MeasuresErrorsInTheTolerancesOfEachComponent) {
  const auto sizeOf = [](const Vec<double>& state, const Vec<double>& reference, Index judged) {
    return errorInTolerances({state, {}, reference, vec({2, 1}), {1e-2, 1e-4}, 0}, judged);
  };
  EXPECT_NEAR(sizeOf(vec({3.1}), vec({3}), 1), 0.1 / (1e-4 * 2 + 1e-2 * 3), 1e-9);
  EXPECT_NEAR(sizeOf(vec({300, 0}), vec({0, 0}), 2), 300 / (1e-4 * 2), 1e-6);
  EXPECT_NEAR(sizeOf(vec({3, 5}), vec({3, 4}), 1), 0, 1e-12);  // the second one is a multiplier
  EXPECT_NEAR(sizeOf(vec({3, 5}), vec({kUnknown, 4}), 2), 1 / (1e-4 + 1e-2 * 4), 1e-6);
  EXPECT_TRUE(std::isnan(sizeOf(vec({3}), vec({kUnknown}), 1)));
  EXPECT_EQ(sizeOf(vec({3}), vec({kInfinity}), 1), kInfinity);
  const Tolerances absolute{1e-2, 1e-4, NormKind::kAbsolute};
  EXPECT_NEAR(errorInTolerances({vec({3.1}), {}, vec({3}), vec({2}), absolute, 0}, 1), 1000, 1e-9);
  EXPECT_NEAR(partOfCover({vec({3.1}), vec({0}), vec({3}), vec({2}), absolute, 0}, 1), 1000. / 3, 1e-3);
}

// One component, scale 2, tolerances 1e-3 (absolute) and 1e-2 (relative): at y = 3 one tolerance is 0.032.
TEST(AuditCoverage, AllowsThreeBarsAndTolerances) {
  const auto part = [](double error, double bar, double accuracy = 0) {
    return partOfCover({vec({3}), vec({bar}), vec({3 - error}), vec({2}), {1e-2, 1e-3}, accuracy}, 1);
  };
  EXPECT_NEAR(part(3 * 0.032, 0), 1, 1e-10);
  EXPECT_NEAR(part(0.5, 0.1), 0.5 / (3 * 0.132), 1e-10);
  EXPECT_NEAR(part(0.5, 0.1, 0.1), 0.5 / (3 * 0.132 + 0.1 * 2.5), 1e-10) << "the reference is known to a tenth";
  EXPECT_TRUE(std::isnan(part(0.5, kUnknown)));
  EXPECT_TRUE(std::isnan(part(kUnknown, 0.1)));
  EXPECT_EQ(part(kInfinity, 0.1), kInfinity) << "there is no solution";
  const auto of = [](const Vec<double>& bars, Index judged) {
    return partOfCover({vec({0, 0}), bars, vec({0, 7}), {}, {1e-2, 1e-3}, 0}, judged);
  };
  EXPECT_NEAR(of(vec({1, 7.0 / 3}), 2), 1, 1e-2);
  EXPECT_GT(of(vec({1, 1e-3}), 1), 1) << "z counts where its bar is known";
  EXPECT_EQ(of(vec({1, kUnknown}), 1), 0) << "and does not where it is not";
  EXPECT_TRUE(std::isnan(of(vec({1, kUnknown}), 2)));
  EXPECT_TRUE(std::isnan(of({}, 2))) << "no bar was measured";
}

TEST(AuditReference, IsReadAsWritten) {
  const Question question{"pendulum", "g=5", 10, false};
  const Answer known = answer("slider_crank", "torque_off_at=0.6");
  Table table;
  addRow(table, answerCells(question, known));
  const auto [same_question, same] = parseAnswer(table, table.rows.front());
  EXPECT_EQ(same_question, question);
  EXPECT_EQ(same.state, known.state);
  EXPECT_EQ(same.other, known.other);
  EXPECT_EQ(same.source, known.source);
  EXPECT_EQ(same.accuracy, known.accuracy);
  EXPECT_EQ(same.kappa, known.kappa);
}

TEST(Run, IntegratesFromAnotherStart) {
  RunSpec spec;
  spec.scene = "dahlquist";
  spec.options.tolerances = {1e-12, 1e-12};
  const auto scene = makeScene<double>("dahlquist");
  const auto record = execute(spec);
  const auto same = integrateFrom(spec, scene.start);
  EXPECT_EQ(same.outcome, Outcome::kSuccess);
  EXPECT_EQ(same.state.x, record.x);
  State<double> twice = scene.start;
  twice.x *= 2;
  EXPECT_NEAR((integrateFrom(spec, twice).state.x - 2 * record.x).norm(), 0, 1e-11);
  const std::atomic<bool> stop = true;
  EXPECT_EQ(integrateFrom(spec, scene.start, {&stop, {}, {}}).outcome, Outcome::kInterrupted);
  spec.method = "cvode_bdf";
  EXPECT_THROW((void)integrateFrom(spec, scene.start), Misuse);
}

// A table of synthetic judgements.
Table judgements(const std::vector<std::vector<std::string>>& rows) {
  return {{},
          {"configuration", "treatment", "scene", "family", "formulation", "judgement", "error", "tolerance", "command",
           "accumulated", "outcome", "error_z", "error_way", "integrator"},
          rows};
}

TEST(AuditJudge, ErrorsAddUpOverStepsAndGrowWithKappa) {
  EXPECT_DOUBLE_EQ(accumulated(100, 5, 1e-6), 5e-4);
  EXPECT_DOUBLE_EQ(accumulated(100, 0.01, 1e-6), 1e-4) << "a step's own error does not shrink below a tolerance";
  EXPECT_TRUE(std::isnan(accumulated(100, kUnknown, 1e-6)));
}

TEST(AuditSummary, CountsAndSortsByExcess) {
  const Table audit = judgements({
      {"default", "default", "hires", "gauss", "index2", "right", "0", "1e-3", "a", "1", "success", "2", "nan",
       "default"},
      {"default", "ignore", "hires", "gauss", "index2", "wrong", "9", "1e-3", "nine times the bar", "8", "success", "0",
       "9", "default"},
      {"default", "locate", "kaps", "gauss", "index2", "wrong", "5e-3", "1e-6", "five times", "6e-3", "success", "0",
       "0", "default"},
      {"paper", "no switches", "kaps", "radau_ia", "ggl", "unjudged", "nan", "1e-6", "d", "nan", "success", "nan",
       "nan", "paper"},
      {"paper", "smooth", "kaps", "radau_ia", "ggl", "ill_conditioned", "2", "1e-6", "e", "nan", "success", "2", "2",
       "paper"},
      {"paper", "iterate", "kaps", "radau_ia", "ggl", "failed", "2", "1e-6", "f", "nan", "inaccurate", "2", "2",
       "paper"},
      {"default", "locate", "kaps", "cvode_bdf", "index2", "failed", "nan", "1e-6", "g", "nan", "stalled", "nan", "nan",
       "cvode_bdf"},
  });
  const Table summary = ofFile(audit, summaryTable);
  const auto row = [&](const std::string& by, const std::string& group) {
    for (const auto& r : summary.rows) {
      if (r[0] == by && r[1] == group) return TableRow(r.begin() + 2, r.end());
    }
    return TableRow{};
  };
  // runs; right, failed, wrong, ill_conditioned, unjudged; wrong ones beside them: set aside, in z, on the way
  EXPECT_EQ(row("all", "all"), (TableRow{"6", "1", "1", "2", "1", "1", "1", "1", "1"}));
  EXPECT_EQ(row("other_library", "cvode_bdf"), (TableRow{"1", "0", "1", "0", "0", "0", "0", "0", "0"}));
  EXPECT_EQ(row("family", "cvode_bdf"), TableRow{}) << "of another library";
  EXPECT_EQ(row("configuration", "default"), (TableRow{"3", "1", "0", "2", "0", "0", "0", "1", "1"}));
  EXPECT_EQ(row("bar", "default"), (TableRow{"2", "1", "0", "1", "0", "0", "0", "1", "0"}));
  EXPECT_EQ(row("bar", "paper"), (TableRow{"1", "0", "0", "0", "0", "1", "0", "0", "0"}));
  EXPECT_EQ(row("configuration_treatment", "paper: smooth"), (TableRow{"1", "0", "0", "0", "1", "0", "1", "0", "0"}));
  EXPECT_EQ(row("formulation", "ggl"), (TableRow{"3", "0", "1", "0", "1", "1", "1", "0", "0"}));
  const auto textOf = [&](std::size_t worst) {
    return ofFile(audit, [&](const auto& file) { return summaryText(file, summary, worst); });
  };
  const std::string text = textOf(2);
  ASSERT_NE(text.find("five times"), text.npos);
  EXPECT_NE(text.find("1 of 2 wrong successes are off by more"), text.npos) << text;
  EXPECT_NE(text.find(fmt::format("  {:<40}{:>16}{:>16}{:>16}{:>16}", "default", 3, 1, 0, 2)), text.npos) << text;
  EXPECT_LT(text.find("nine times the bar"), text.find("five times"));
  EXPECT_EQ(textOf(1).find("five times"), std::string::npos);
}

TEST(FinalStates, AreWrittenAsTextAndReadBack) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "states.csv";
  RunRecord record;
  record.u = vec({1, 2});
  record.v = vec({3, 0.1});
  record.x = vec({kUnknown});
  writeTable(file, {{}, {"key", "state"}, {{"key", vectorText(componentsOf(record))}}});
  EXPECT_EQ(vectorText(readStates(file).at("key")), "1 2 3 0.1 nan");
}

}  // namespace
}  // namespace irk::audit
