#include "experiments/audit/audit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

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
#include "tests/experiments/study_runs.h"

namespace irk::audit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Bits and choices are part of the study: other ones would be another audit.
TEST(AuditDice, AreTheSameOnEveryMachine) {
  Dice dice("1 run 0");
  EXPECT_EQ(dice.uniform(), 0x1.675a664420499p-1);  // by another implementation of MT19937-64
  EXPECT_EQ(dice.below(1000), 28);
  const double weights[] = {0, 1, 0, 3, 0};
  int counts[5] = {};
  for (int i = 0; i < 4000; ++i) ++counts[dice.weighted(weights)];
  EXPECT_EQ(counts[0] + counts[2] + counts[4], 0);
  EXPECT_NEAR(counts[1], 1000, 100);  // 3.7 standard deviations
  std::set<Index> seen;
  for (int i = 0; i < 200; ++i) seen.insert(dice.between(3, 7));
  EXPECT_EQ(seen, (std::set<Index>{3, 4, 5, 6, 7}));
}

std::vector<std::string> texts(const std::vector<DrawnRun>& runs) {
  std::vector<std::string> all;
  for (const auto& run : runs) all.push_back(run.treatment + " " + canonicalText(run.spec));
  return all;
}

TEST(AuditDraw, DependsOnTheSeedAlone) {
  const auto first = texts(drawnRuns({.runs = 60}));
  EXPECT_EQ(first, texts(drawnRuns({.runs = 60})));
  auto longer = texts(drawnRuns({.runs = 80}));
  longer.resize(60);
  EXPECT_EQ(first, longer) << "a shorter audit is the beginning of a longer one";
  const auto other = texts(drawnRuns({.runs = 60, .seed = 2}));
  int same = 0;
  for (std::size_t i = 0; i < other.size(); ++i) same += first[i] == other[i];
  EXPECT_LT(same, 3);
}

TEST(AuditDraw, ReachesEveryScenesAxisAndTolerance) {
  std::set<std::string> scenes, configurations, treatments, formulations, families, methods;
  std::set<double> tolerances;
  int with_settings = 0;
  const auto runs = drawnRuns({.runs = 2500});
  for (const auto& [spec, treatment] : runs) {
    scenes.insert(spec.scene);
    configurations.insert(spec.configuration);
    treatments.insert(treatment);
    formulations.insert(std::string(idOf(spec.formulation)));
    methods.insert(spec.method);
    tolerances.insert(spec.options.tolerances.rtol);
    EXPECT_EQ(spec.options.tolerances.rtol, spec.options.tolerances.atol);
    with_settings += !spec.settings.empty();
    for (const auto& [name, value] : spec.settings) {
      const bool unknowns = name == "m" && spec.scene == "beam_chain";
      EXPECT_TRUE(!unknowns || std::stoi(value) <= 100) << value;
      EXPECT_TRUE(name != "elements" || std::stoi(value) <= 4) << value;
      EXPECT_TRUE(!name.starts_with("smoothing") || treatment == "smooth" || treatment == kNoSwitches);
    }
    // What is left open is the default, whatever that is.
    if (treatment == kDefaultTreatment || treatment == kNoSwitches) {
      RunSpec configured;
      findField("configuration").set(configured, spec.configuration);
      EXPECT_EQ(spec.discontinuity, configured.discontinuity);
    } else {
      EXPECT_EQ(idOf(spec.discontinuity), treatment);
    }
  }
  EXPECT_EQ(scenes.size(), sceneCatalogue().size());
  EXPECT_EQ(configurations.size(), irk::configurations().size());
  EXPECT_EQ(treatments, (std::set<std::string>{"default", "ignore", "iterate", "locate", "no switches", "smooth"}));
  EXPECT_EQ(formulations.size(), named<Formulation>().size());
  EXPECT_EQ(tolerances.size(), 12u);
  for (const auto* id : {"gauss_20", "radau_iia_1", "lobatto_iiid_4", "radau_ia"}) {
    EXPECT_TRUE(methods.contains(id)) << id;
  }
  EXPECT_GT(with_settings, 700);  // half of the runs, of the scenes that have parameters
}

// A word of the command line that starts an option, and what follows it.
SolveOptions parsed(const std::string& command) {
  std::istringstream in(command);
  std::string irk, solve, option, value;
  SolveOptions options;
  in >> irk >> solve >> options.scene;
  EXPECT_EQ(irk + " " + solve, "irk solve");
  while (in >> option >> value) {
    std::string field = option.substr(2);
    std::replace(field.begin(), field.end(), '-', '_');
    if (field == "set") {
      options.settings.push_back(value);
    } else if (field == "tol") {
      options.tol = value;
    } else {
      options.fields.emplace_back(field, value);
    }
  }
  return options;
}

TEST(AuditDraw, CommandsRepeatTheRuns) {
  auto runs = drawnRuns({.runs = 300});
  runs[0].spec.t_end *= 0.3;
  for (const auto& run : runs) {
    const std::string command = commandOf(run);
    EXPECT_EQ(specKey(solveSpec(parsed(command))), specKey(run.spec)) << command;
  }
}

Evidence evidence(double error, double tolerance) {
  return {.success = true, .tolerance = tolerance, .error = error, .accuracy = 1e-12, .kappa = 10};
}

TEST(AuditJudge, DrawsEveryLine) {
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
  // Hidden constraints: no step leaves a perturbed start.
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

// A table of made-up judgements.
Table judgements(const std::vector<std::vector<std::string>>& rows) {
  return {{}, {"configuration", "treatment", "scene", "family", "formulation", "judgement", "error", "tolerance", "command"}, rows};
}

TEST(AuditSummary, CountsAndSortsByExcess) {
  const Table audit = judgements({
      {"default", "default", "hires", "gauss", "index2", "right", "0", "1e-3", "a"},
      {"default", "ignore", "hires", "gauss", "index2", "wrong", "9", "1e-3", "nine times the bar"},
      {"default", "locate", "kaps", "gauss", "index2", "wrong", "5e-3", "1e-6", "five times"},
      {"paper", "no switches", "kaps", "radau_ia", "ggl", "unjudged", "nan", "1e-6", "d"},
      {"paper", "smooth", "kaps", "radau_ia", "ggl", "ill_conditioned", "nan", "1e-6", "e"},
      {"paper", "iterate", "kaps", "radau_ia", "ggl", "failed", "nan", "1e-6", "f"},
  });
  const Table summary = summaryTable(audit);
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
  const std::string text = summaryText(audit, summary, 2);
  ASSERT_NE(text.find("five times"), text.npos);
  EXPECT_LT(text.find("nine times the bar"), text.find("five times"));
  EXPECT_EQ(summaryText(audit, summary, 1).find("five times"), std::string::npos);
}

TEST(FinalStates, AreWrittenAsTextAndReadBack) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "states.csv";
  RunRecord record;
  record.u = vec({1, 2});
  record.v = vec({3, 0.1});
  record.x = vec({kUnknown});
  writeTable(file, {{}, {"key", "state"}, {{"key", vectorText(componentsOf(record))}}});
  EXPECT_EQ(vectorText(readStates(file).at("key")), "1 2 3 0.10000000000000001 nan");
}

constexpr const char* kSmall = "title = 'small'\n[audit]\nruns = 60\ntime_limit = 0.5\n";

TEST(Audit, StudyDrawsInsteadOfBlocks) {
  const auto study = [](const std::string& text, StudyVariant variant) {
    return parseStudy(text, "audit.toml", variant);
  };
  const std::string quick = "[audit]\nruns = 30\nseed = 3\n[audit.quick]\nruns = 10\n";
  EXPECT_EQ(study(quick, StudyVariant::kFull).series.size(), 30u);
  const auto small = study(quick, StudyVariant::kQuick);
  ASSERT_EQ(small.series.size(), 10u);
  EXPECT_EQ(specKey(small.series[9].runs[0]), specKey(drawnRuns({.runs = 10, .seed = 3})[9].spec));
  EXPECT_TRUE(containsAll(misuseOf([&] { study("[audit]\nrun = 3\n", StudyVariant::kFull); }),
                          {"audit.toml", "run", "runs"}));
  EXPECT_TRUE(containsAll(misuseOf([&] { study("[audit]\n[[block]]\nscene='hires'\n", StudyVariant::kFull); }),
                          {"[[block]]"}));
}

/// One small audit for all tests of this suite.
class SmallAudit : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    study_ = new Study(parseStudy(kSmall, "audit.toml", StudyVariant::kFull));
    runs_ = new Table(run());
    text_ = new std::string(auditRuns(*study_, *runs_, folder(), 2, quiet_));
  }
  static void TearDownTestSuite() {
    delete folder_;
    delete study_;
    delete runs_;
    delete text_;
  }
  static Table run() {
    RunnerOptions options;
    options.results = folder_->path();
    options.jobs = 2;
    return runStudy(*study_, options, quiet_);
  }
  static std::filesystem::path folder() { return folder_->path() / "audit"; }

  static inline TemporaryFolder* folder_;
  static inline Study* study_;
  static inline Table* runs_;
  static inline std::string* text_;
  static inline std::ostringstream quiet_;
};

TEST_F(SmallAudit, JudgesEveryRun) {
  const Table table = readTable(folder() / "audit.csv");
  ASSERT_EQ(table.rows.size(), 60u);
  std::map<std::string, int> counts;
  for (const auto& row : table.rows) {
    ++counts[textAt(table, row, "judgement")];
    if (textAt(table, row, "judgement") == "right") {
      EXPECT_LE(numberAt(table, row, "error"), bar(numberAt(table, row, "tolerance")));
      EXPECT_EQ(numberAt(table, row, "error") / numberAt(table, row, "tolerance"),
                numberAt(table, row, "error_over_tolerance"));
    }
    EXPECT_EQ(specKey(solveSpec(parsed(textAt(table, row, "command")))), textAt(table, row, "key"));
  }
  EXPECT_GT(counts["right"], 30);
  const Table summary = readTable(folder() / "audit_summary.csv");
  for (const char* by : {"all", "configuration", "treatment", "scene", "family", "formulation",
                         "configuration_treatment"}) {
    int runs = 0, right = 0;
    for (const auto& row : summary.rows) {
      if (textAt(summary, row, "by") != by) continue;
      runs += static_cast<int>(numberAt(summary, row, "runs"));
      right += static_cast<int>(numberAt(summary, row, "right"));
    }
    EXPECT_EQ(runs, 60) << by;
    EXPECT_EQ(right, counts["right"]) << by;
  }
  EXPECT_TRUE(containsAll(*text_, {"by configuration", "default", "embedded", "paper", "variable"}));
}

TEST_F(SmallAudit, FindsADamagedResult) {
  const auto drawn = drawnRuns(*study_->audit);
  auto states = readStates(folder() / "states.csv");
  std::set<Question> questions;
  for (const auto& run : drawn) questions.insert(questionOf(run.spec));
  std::ostringstream quiet;
  const Answers answers = answersTo(questions, folder() / "references.csv", 2, quiet);
  EXPECT_EQ(quiet.str().find("runs made"), std::string::npos) << "all of them are known";
  const Table table = auditTable(drawn, *runs_, states, answers);
  // The first component of the right runs is moved by `bars` times what is allowed.
  const auto moved = [&](double bars) {
    auto other = states;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const auto& spec = drawn[i].spec;
      if (textAt(table, table.rows[i], "judgement") != "right") continue;
      const auto scale = makeScene<double>(spec.scene, spec.settings).scale;
      const Vec<double>& state = states.at(table.rows[i][1]);
      const double size = std::max(std::abs(state[0]), scale.size() > 0 ? scale[0] : 1);
      other.at(table.rows[i][1])[0] = state[0] + bars * bar(spec.options.tolerances.atol) * size;
    }
    return auditTable(drawn, *runs_, other, answers);
  };
  const Table same = moved(0), damaged = moved(3);
  int checked = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_EQ(same.rows[i], table.rows[i]);
    // A magnitude is known to less than the bar where the bar is less than 1.
    const bool sharp = numberAt(table, table.rows[i], "tolerance") <= 1e-4;
    if (!sharp || textAt(table, table.rows[i], "judgement") != "right") continue;
    EXPECT_EQ(textAt(damaged, damaged.rows[i], "judgement"), "wrong") << commandOf(drawn[i]);
    ++checked;
  }
  EXPECT_GT(checked, 20);
  EXPECT_TRUE(containsAll(summaryText(damaged, summaryTable(damaged), 3),
                          {"the worst successes that are wrong", "irk solve "}));
}

TEST_F(SmallAudit, GoesOnWhereItWas) {
  const Table again = run();
  EXPECT_EQ(again.rows, runs_->rows) << "nothing is made again: times are the same";
  // A run whose state is lost is made again.
  const auto parts = partsOf(folder(), "states");
  ASSERT_EQ(parts.size(), 1u);
  Table states = readTable(parts.front());
  const auto lost = states.rows.front();
  states.rows.erase(states.rows.begin());
  writeTable(parts.front(), states);
  run();
  const auto found = readStates(folder() / "states.csv");
  ASSERT_TRUE(found.contains(lost[0]));
  EXPECT_EQ(vectorText(found.at(lost[0])), lost[1]);
}

// Without their references, wrong runs would count as unjudged ones.
TEST_F(SmallAudit, InterruptedLeavesNoCounts) {
  TemporaryFolder copy;
  std::filesystem::copy(folder(), copy.path(), std::filesystem::copy_options::recursive);
  const auto references = readTable(copy.path() / "references.csv");
  std::string text;
  {
    const InterruptScope interrupts;
    std::raise(SIGINT);
    text = auditRuns(*study_, *runs_, copy.path(), 2, quiet_);
  }
  EXPECT_TRUE(containsAll(text, {"interrupted"}));
  EXPECT_FALSE(std::filesystem::exists(copy.path() / "audit.csv"));
  EXPECT_FALSE(std::filesystem::exists(copy.path() / "audit_summary.csv"));
  EXPECT_EQ(readTable(copy.path() / "references.csv").rows, references.rows);
  const InterruptScope uninterrupted;  // the flag is false again
  EXPECT_EQ(auditRuns(*study_, *runs_, copy.path(), 2, quiet_), *text_);
}

TEST_F(SmallAudit, IsDrawn) {
  for (const std::string script : {"audit", "audit_errors"}) {
    const auto out = folder() / script;
    std::ostringstream err;
    ASSERT_TRUE(drawFigure(script + ".gp",
                           "data='" + folder().string() + "'; out='" + out.string() + "'",
                           IRK_SOURCE_DIR, err))
        << err.str();
    std::ifstream in(out.string() + ".svg");
    const std::string svg{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    EXPECT_TRUE(containsAll(svg, {"default", "paper", "embedded", "variable"}));
    EXPECT_TRUE(std::filesystem::exists(out.string() + ".png"));
  }
}

}  // namespace
}  // namespace irk::audit
