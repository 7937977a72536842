#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <csignal>
#include <set>
#include <sstream>

#include "experiments/audit/audit.h"
#include "experiments/base/interrupt.h"
#include "experiments/commands/commands.h"
#include "experiments/report/report.h"
#include "experiments/runner/runner.h"
#include "experiments/runs/final_states.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/study_reader.h"
#include "irk/collections.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/audit/audited.h"
#include "tests/experiments/study_runs.h"

namespace irk::audit {
namespace {

TEST(Audit, StudyDrawsInsteadOfBlocks) {
  const auto study = [](const std::string& text, StudyVariant variant) {
    return parseStudy(text, "audit.toml", variant);
  };
  const std::string quick = "[audit]\nruns = 30\nseed = 3\n[audit.quick]\nruns = 10\n";
  EXPECT_EQ(study(quick, StudyVariant::kFull).series.size(), 30u);
  const auto small = study(quick, StudyVariant::kQuick);
  ASSERT_EQ(small.series.size(), 10u);
  EXPECT_EQ(specKey(small.series[9].runs[0]), specKey(Draw({.runs = 10, .seed = 3})[9].spec));
  EXPECT_TRUE(
      containsAll(misuseOf([&] { study("[audit]\nrun = 3\n", StudyVariant::kFull); }), {"audit.toml", "run", "runs"}));
  EXPECT_TRUE(
      containsAll(misuseOf([&] { study("[audit]\n[[block]]\nscene='hires'\n", StudyVariant::kFull); }), {"[[block]]"}));
}

TEST(Audit, DrawsAmongTheScenesThatAreAskedFor) {
  const auto study = [](const std::string& scenes) {
    return parseStudy("[audit]\nruns = 40\nscene = " + scenes + "\n", "audit.toml", StudyVariant::kFull);
  };
  const auto drawn = [&](const std::string& scenes) {
    std::set<std::string> ids;
    for (const auto& series : study(scenes).series) ids.insert(series.runs[0].scene);
    return ids;
  };
  EXPECT_EQ(drawn("'pendulum'"), std::set<std::string>{"pendulum"});
  EXPECT_EQ(drawn("['pendulum', 'kepler']"), (std::set<std::string>{"pendulum", "kepler"}));
  for (const auto& id : drawn("'@switching'")) {
    const auto scenes = scenesOf("switching");
    EXPECT_NE(std::find(scenes.begin(), scenes.end(), id), scenes.end()) << id;
  }
  // In another folder, too, where a code of a library (code@library.so) is looked for beside the study.
  const char* collection = "[audit]\nruns = 40\nscene = '@switching'\n";
  EXPECT_EQ(parseStudy(collection, "folder/audit.toml", StudyVariant::kFull).series.size(), 40u);
  EXPECT_TRUE(containsAll(misuseOf([&] { study("['pendulum', 'pendulun']"); }), {"audit.toml:3", "pendulun"}));
  EXPECT_TRUE(containsAll(misuseOf([&] { study("'@nosuch'"); }), {"audit.toml:3", "nosuch"}));
}

constexpr const char* kSmall = "title = 'small'\n[audit]\nruns = 60\ntime_limit = 0.5\n";

/// One small audit, shared by all tests of this suite.
class SmallAudit : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    study_ = new Study(parseStudy(kSmall, "audit.toml", StudyVariant::kFull));
    runs_ = new Table(run());
    text_ = new std::string(auditRuns(*study_, folder(), 2, quiet_));
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
  int ours = 0;
  for (const auto& row : table.rows) {
    const bool is_ours = textAt(table, row, "integrator") == textAt(table, row, "configuration");
    ours += is_ours;
    if (is_ours) ++counts[textAt(table, row, "judgement")];
    if (textAt(table, row, "judgement") == "right") {
      EXPECT_LE(numberAt(table, row, "error"), bar(numberAt(table, row, "tolerance")));
      EXPECT_EQ(numberAt(table, row, "error") / numberAt(table, row, "tolerance"),
                numberAt(table, row, "error_over_tolerance"));
    }
    EXPECT_EQ(specKey(solveSpec(parsed(textAt(table, row, "command")))), textAt(table, row, "key"));
  }
  EXPECT_GT(counts["right"], 20);
  EXPECT_GT(ours, 40);
  EXPECT_LT(ours, 60) << "some are of other libraries";
  const Table summary = readTable(folder() / "audit_summary.csv");
  for (const char* by :
       {"all", "configuration", "treatment", "scene", "family", "formulation", "configuration_treatment"}) {
    int runs = 0, right = 0;
    for (const auto& row : summary.rows) {
      if (textAt(summary, row, "by") != by) continue;
      runs += static_cast<int>(numberAt(summary, row, "runs"));
      right += static_cast<int>(numberAt(summary, row, "right"));
    }
    EXPECT_EQ(runs, ours) << by;
    EXPECT_EQ(right, counts["right"]) << by;
  }
  EXPECT_TRUE(containsAll(*text_, {"by configuration", "default", "embedded", "paper", "variable", "the error bar",
                                   "second / first", "the solver's own word"}));
}

TEST_F(SmallAudit, FindsADamagedResult) {
  const Draw drawn(*study_->audit);
  const auto states = readStates(folder() / "states.csv");
  std::set<Question> questions;
  for (std::size_t i = 0; i < drawn.size(); ++i) questions.insert(questionOf(drawn[i].spec));
  std::ostringstream quiet;
  const Answers answers = answersTo(questions, folder() / "references.csv", 2, quiet);
  EXPECT_EQ(quiet.str().find("runs made"), std::string::npos) << "all of them are known";
  const auto bars = readStates(folder() / "states.csv", "bar");
  const auto audited = [&](const std::map<std::string, Vec<double>>& ends) {
    Table written{{}, {"key", "state", "bar"}, {}};
    for (const auto& [key, state] : ends) written.rows.push_back({key, vectorText(state), vectorText(bars.at(key))});
    return ofFile(written, [&](const auto& file) {
      return writtenBy([&](const auto& to) { writeAudit(drawn, folder() / "runs.csv", file, answers, to); });
    });
  };
  const Table table = audited(states);
  // Moves the first component of all right runs by `times` the bar.
  const auto moved = [&](double times) {
    auto other = states;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const auto spec = drawn[i].spec;
      if (textAt(table, table.rows[i], "judgement") != "right") continue;
      const bool absolute = spec.options.tolerances.norm == NormKind::kAbsolute;
      const auto scale = absolute ? Vec<double>() : makeScene<double>(spec.scene, spec.settings).scale;
      const Vec<double>& state = states.at(table.rows[i][1]);
      const double size = std::max(std::abs(state[0]), scale.size() > 0 ? scale[0] : 1);
      other.at(table.rows[i][1])[0] = state[0] + times * bar(numberAt(table, table.rows[i], "tolerance")) * size;
    }
    return audited(other);
  };
  const Table same = moved(0), damaged = moved(3);
  int checked = 0, covered = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_EQ(same.rows[i], table.rows[i]);
    // An error of several bars is detected only if the bar is below 1.
    const bool sharp = numberAt(table, table.rows[i], "tolerance") <= 1e-4;
    if (!sharp || textAt(table, table.rows[i], "judgement") != "right") continue;
    EXPECT_EQ(textAt(damaged, damaged.rows[i], "judgement"), "wrong") << table.rows[i].back();
    ++checked;
    // 3000 tolerances are beyond three error bars of at most 100.
    if (!(numberAt(table, table.rows[i], "error_bar_tolerances") < 100)) continue;
    EXPECT_GT(numberAt(damaged, damaged.rows[i], "part_of_cover"), 1) << table.rows[i].back();
    covered += numberAt(table, table.rows[i], "part_of_cover") <= 1;
  }
  EXPECT_GT(checked, 15);
  EXPECT_GT(covered, 10);
  const auto text = ofFile(damaged, [](const auto& file) { return summaryText(file, summaryTable(file), 3); });
  EXPECT_TRUE(containsAll(text, {"the worst successes that are wrong", "irk solve "}));
}

TEST_F(SmallAudit, ResumesWhereItWasInterrupted) {
  const Table again = run();
  EXPECT_EQ(again.rows, runs_->rows) << "nothing is made again: times are the same";
  // A run whose state is missing is made again.
  const auto parts = partsOf(folder(), "states");
  ASSERT_EQ(parts.size(), 1u);
  Table states = readPartTable(parts.front());
  const auto lost = states.rows.front();
  states.rows.erase(states.rows.begin());
  writePartTable(parts.front(), states);
  run();
  const auto found = readStates(folder() / "states.csv");
  ASSERT_TRUE(found.contains(lost[0]));
  EXPECT_EQ(vectorText(found.at(lost[0])), lost[1]);
}

// Without their references wrong runs would count as unjudged.
TEST_F(SmallAudit, InterruptedLeavesNoCounts) {
  TemporaryFolder copy;
  std::filesystem::copy(folder(), copy.path(), std::filesystem::copy_options::recursive);
  const auto references = readTable(copy.path() / "references.csv");
  // Another test may have made a run again, with other times.
  const std::string before = auditRuns(*study_, copy.path(), 2, quiet_);
  std::string text;
  {
    const InterruptScope interrupts;
    std::raise(SIGINT);
    text = auditRuns(*study_, copy.path(), 2, quiet_);
  }
  EXPECT_TRUE(containsAll(text, {"interrupted"}));
  EXPECT_FALSE(std::filesystem::exists(copy.path() / "audit.csv"));
  for (const char* table : {"audit_summary.csv", "audit_error_bar.csv", "audit_own_word.csv"}) {
    EXPECT_FALSE(std::filesystem::exists(copy.path() / table)) << table;
  }
  EXPECT_EQ(readTable(copy.path() / "references.csv").rows, references.rows);
  const InterruptScope uninterrupted;  // the flag is false again
  EXPECT_EQ(auditRuns(*study_, copy.path(), 2, quiet_), before);
}

TEST_F(SmallAudit, IsDrawn) {
  for (const std::string script : {"audit", "audit_errors"}) {
    const auto out = folder() / script;
    std::ostringstream err;
    ASSERT_TRUE(
        drawFigure(script + ".gp", "data='" + folder().string() + "'; out='" + out.string() + "'", IRK_SOURCE_DIR, err))
        << err.str();
    const std::string svg = readInputFile(out.string() + ".svg");
    EXPECT_TRUE(containsAll(svg, {"default", "paper", "embedded", "variable"}));
    EXPECT_TRUE(std::filesystem::exists(out.string() + ".png"));
  }
}

}  // namespace
}  // namespace irk::audit
