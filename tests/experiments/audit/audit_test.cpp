#include <gtest/gtest.h>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "experiments/audit/audit.h"
#include "experiments/base/interrupt.h"
#include "experiments/commands/commands.h"
#include "experiments/report/report.h"
#include "experiments/runner/runner.h"
#include "experiments/runs/configurations.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/final_states.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/dice.h"
#include "experiments/study/study_reader.h"
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
  EXPECT_EQ(judge(e), Judgement::kUnjudged);
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

Answer answer(const std::string& scene, const std::string& settings, bool smooth = false) {
  RunSpec spec;
  spec.scene = scene;
  findField("settings").set(spec, settings);
  if (smooth) spec.discontinuity = Discontinuity::kSmooth;
  return answerOf(questionOf(resolved(spec)), nullptr);
}

TEST(AuditReference, IsExactOrFromAFileOrComputed) {
  const auto exact = answer("pendulum", "g=5");
  EXPECT_EQ(exact.source, "exact");
  EXPECT_EQ(exact.accuracy, 0);
  EXPECT_EQ(exact.remark, "") << "a strict run agrees";
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

TEST(AuditReference, KnowsTheConditioning) {
  // y' = -y + i y on [0, 1]: perturbations shrink to 1/e; two signs may add up to sqrt 2 of it.
  const auto decay = answer("dahlquist", "");
  EXPECT_GT(decay.kappa, 0.2);
  EXPECT_LT(decay.kappa, 0.8);
  // x' = 20 x grows by e^20.
  EXPECT_GT(answer("dahlquist", "lambda_re=20 lambda_im=0").kappa, kLargestKappa);
  EXPECT_GT(answer("kepler", "").kappa, kLargestKappa);
  // Hidden constraints forbid every step from a perturbed start.
  EXPECT_LT(answer("index2_nonlinear", "").kappa, kLargestKappa);
  EXPECT_LT(answer("index3_nonlinear", "").kappa, kLargestKappa);
}

TEST(AuditReference, IsReadAsWritten) {
  const Question question{"pendulum", "g=5", 10, false};
  const Answer known = answer("slider_crank", "torque_off_at=0.6");
  const Table table{{}, answerColumns(), {answerRow(question, known)}};
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
           "accumulated"},
          rows};
}

TEST(AuditJudge, ErrorsAddUpOverStepsAndGrowWithKappa) {
  EXPECT_DOUBLE_EQ(accumulated(100, 5, 1e-6), 5e-4);
  EXPECT_DOUBLE_EQ(accumulated(100, 0.01, 1e-6), 1e-4) << "a step's own error does not shrink below a tolerance";
  EXPECT_TRUE(std::isnan(accumulated(100, kUnknown, 1e-6)));
}

TEST(AuditSummary, CountsAndSortsByExcess) {
  const Table audit = judgements({
      {"default", "default", "hires", "gauss", "index2", "right", "0", "1e-3", "a", "1"},
      {"default", "ignore", "hires", "gauss", "index2", "wrong", "9", "1e-3", "nine times the bar", "8"},
      {"default", "locate", "kaps", "gauss", "index2", "wrong", "5e-3", "1e-6", "five times", "6e-3"},
      {"paper", "no switches", "kaps", "radau_ia", "ggl", "unjudged", "nan", "1e-6", "d", "nan"},
      {"paper", "smooth", "kaps", "radau_ia", "ggl", "ill_conditioned", "nan", "1e-6", "e", "nan"},
      {"paper", "iterate", "kaps", "radau_ia", "ggl", "failed", "nan", "1e-6", "f", "nan"},
  });
  const Table summary = ofFile(audit, summaryTable);
  const auto row = [&](const std::string& by, const std::string& group) {
    for (const auto& r : summary.rows) {
      if (r[0] == by && r[1] == group) return TableRow(r.begin() + 2, r.end());
    }
    return TableRow{};
  };
  // runs, right, failed, wrong, ill_conditioned, unjudged
  EXPECT_EQ(row("all", "all"), (TableRow{"6", "1", "1", "2", "1", "1"}));
  EXPECT_EQ(row("configuration", "default"), (TableRow{"3", "1", "0", "2", "0", "0"}));
  EXPECT_EQ(row("bar", "default"), (TableRow{"2", "1", "0", "1", "0", "0"}));
  EXPECT_EQ(row("bar", "paper"), (TableRow{"1", "0", "0", "0", "0", "1"}));
  EXPECT_EQ(row("configuration_treatment", "paper: smooth"), (TableRow{"1", "0", "0", "0", "1", "0"}));
  EXPECT_EQ(row("formulation", "ggl"), (TableRow{"3", "0", "1", "0", "1", "1"}));
  const auto textOf = [&](std::size_t worst) {
    return ofFile(audit, [&](const auto& file) { return summaryText(file, summary, worst); });
  };
  const std::string text = textOf(2);
  ASSERT_NE(text.find("five times"), text.npos);
  EXPECT_NE(text.find("1 of 2 wrong successes are off by more"), text.npos) << text;
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
