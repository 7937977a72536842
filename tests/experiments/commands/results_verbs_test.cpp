#include <gtest/gtest.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "experiments/base/file_lock.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/builtin_studies.h"
#include "experiments/study/study.h"
#include "experiments/study/study_reader.h"
#include "tests/experiments/commands/verbs.h"
#include "tests/experiments/program.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

TEST_F(Verbs, AFileDoesNotDisturbABuiltInStudy) {
  const std::string peers = folder_.path() / "peers.toml";
  std::ofstream(peers) << kSmall;
  const Ended ended = program({"run", peers, "--results", results()});
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(containsAll(ended.err, {"peers.toml", "built-in study", "another name"}));
  EXPECT_FALSE(exists("peers"));
}

TEST_F(Verbs, QuickResultsAreATreeOfTheirOwn) {
  std::ofstream(study(), std::ios::app) << "[block.quick]\nmethods = \"radau_iia_3\"\n";
  ASSERT_EQ(run().status, 0);
  ASSERT_EQ(run("results", {"--quick"}).status, 0);
  EXPECT_EQ(runs().rows.size(), 8u);
  EXPECT_EQ(readTable(results() + "/quick/small/runs.csv").rows.size(), 4u);
  std::filesystem::rename(results() + "/quick/small", results() + "/quick/drift");
  EXPECT_EQ(program({"report", "--quick", "--results", results()}).status, 0);
  EXPECT_TRUE(exists("quick/report/index.html"));
  EXPECT_FALSE(exists("report/index.html"));
}

TEST_F(Verbs, ASecondWriterIsStatusOne) {
  std::filesystem::create_directories(results() + "/small");
  FileLock lock(results() + "/small/lock");
  ASSERT_EQ(lock.take(), FileLock::State::kTaken);
  std::ofstream(results() + "/small/lock") << "elsewhere 4711 2026-01-01T00:00:00Z\n";
  const Ended ended = run();
  EXPECT_EQ(ended.status, 1);
  EXPECT_TRUE(containsAll(ended.err, {"elsewhere", "4711", "2026-01-01T00:00:00Z", "--wait"}));
  EXPECT_EQ(run("results", {"--stale", "forget"}).status, 2);
  EXPECT_EQ(run("results", {"--times", "there"}).status, 2);
  const Ended status = program({"status", study(), "--results", results()});
  EXPECT_EQ(status.status, 0);
  EXPECT_TRUE(containsAll(status.out, {"8 runs to make", "4711"}));
}

// The verbs of a paper in their order: run, plot, claims, report.
TEST_F(Verbs, PlotClaimsAndReportOfWhatWasRun) {
  ASSERT_EQ(run().status, 0);
  std::filesystem::rename(results() + "/small", results() + "/drift");
  const Ended plotted = program({"plot", "drift", "--results", results()});
  EXPECT_EQ(plotted.status, 0) << plotted.err;
  for (const auto* name : {"drift_pendulum", "drift_stages", "drift_cost"}) {
    for (const auto* ending : {".svg", ".png"}) {
      EXPECT_TRUE(exists("report/figures/" + std::string(name) + ending)) << name << ending;
    }
  }
  const Ended claims = program({"claims", "--results", results()});
  EXPECT_EQ(claims.status, 0) << claims.err;
  EXPECT_NE(claims.out.find("  drift over the error  "), claims.out.npos);
  const Ended report = program({"report", "--results", results()});
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_TRUE(containsAll(report.out, {"index.html"}));
  const std::string page = readInputFile(results() + "/report/index.html");
  EXPECT_TRUE(containsAll(page, {"figures/drift_pendulum.svg", "id=\"C7\"", "study_drift"}));
  EXPECT_EQ(page.find("figures/work_slider_crank.svg"), page.npos) << "of a study that was not run";
  EXPECT_EQ(page.find("@CLAIMS@"), page.npos);
  EXPECT_EQ(page.find("@FIGURES@"), page.npos);
}

TEST_F(Verbs, FiguresDoNotJoinTimesOfTwoMachines) {
  ASSERT_EQ(run().status, 0);
  const auto part = partsOf(results() + "/small").front();
  Table rows = readPartTable(part);
  for (auto& row : rows.rows) {
    if (textAt(rows, row, "formulation") == "ggl") row[rows.column("cpu_environment")] = "elsewhere";
  }
  writePartTable(part, rows);
  const Ended refused = run();
  EXPECT_EQ(refused.status, 1);
  EXPECT_TRUE(containsAll(refused.err, {"2 timing classes", "elsewhere", "--times here"}));
  std::filesystem::rename(results() + "/small", results() + "/drift");
  const Ended plotted = program({"plot", "drift", "--results", results()});
  EXPECT_EQ(plotted.status, 1);
  EXPECT_TRUE(containsAll(plotted.err, {"figures of drift have no times", "2 timing classes"}));
  // Claim C11 reads the study k_form.
  std::filesystem::rename(results() + "/drift", results() + "/k_form");
  const Ended claims = program({"claims", "--results", results()});
  EXPECT_TRUE(containsAll(claims.out, {"study k_form: times of 2 timing classes"}));
  std::filesystem::rename(results() + "/k_form", results() + "/small");
  const Ended here = run("results", {"--times", "here"});
  EXPECT_EQ(here.status, 0) << here.err;
  const Table all = runs();
  for (const auto& row : all.rows) EXPECT_EQ(numberAt(all, row, "cpu_runs"), 2);
}

TEST_F(Verbs, PlotAndReportFailWhereGnuplotDoes) {
  std::filesystem::create_directories(results());
  const Ended nothing = program({"plot", "drift", "--results", results()});
  EXPECT_EQ(nothing.status, 1);
  EXPECT_TRUE(containsAll(nothing.err, {"'drift'", "irk run drift"}));
  ASSERT_EQ(run().status, 0);
  Table damaged = runs();
  std::filesystem::rename(results() + "/small", results() + "/drift");
  damaged.columns[damaged.column("formulation")] = "formulatio";
  for (auto& row : damaged.rows) row[damaged.column("scene")] = "pendulum";
  writeTable(std::filesystem::path(results()) / "drift" / "runs.csv", damaged);
  const Ended plotted = program({"plot", "drift", "--results", results()});
  EXPECT_EQ(plotted.status, 1) << plotted.err;
  EXPECT_EQ(program({"report", "--results", results()}).status, 1);
}

// The first signal ends the run after its current step. Finished runs are kept, and the same command continues from
// there.
TEST_F(Verbs, AnInterruptKeepsFinishedRuns) {
  std::ofstream(study()) << "title = \"Long\"\n[[block]]\nscene = \"kepler\"\nt_end = 400\n"
                            "methods = [\"radau_iia_2\", \"radau_iia_3\", \"gauss_2\", \"gauss_3\", \"gauss_4\"]\n"
                            "tolerances = [1e-5, 1e-6, 1e-7, 1e-8]\n";
  const auto folder = std::filesystem::path(results()) / "small";
  std::atomic<bool> done = false;
  std::thread signal([&] {
    while (!done) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      if (rowsInParts(folder) < 2 || done) continue;
      std::raise(SIGINT);
      return;
    }
  });
  const Ended stopped = program({"run", study(), "--results", results(), "--jobs", "2"});
  done = true;
  signal.join();
  ASSERT_EQ(stopped.status, 130) << stopped.out;
  const Table kept = runs();
  ASSERT_GE(kept.rows.size(), 2u);
  ASSERT_LT(kept.rows.size(), 20u) << "the machine is too fast for this test";
  for (const auto& row : kept.rows) {
    const auto outcome = textAt(kept, row, "outcome");
    EXPECT_TRUE(outcome == "success" || outcome == "inaccurate") << outcome;  // ended, not stopped
  }
  ASSERT_EQ(program({"run", study(), "--results", results(), "--jobs", "2"}).status, 0);
  const Table whole = runs();
  ASSERT_EQ(whole.rows.size(), 20u);
  std::size_t same = 0;
  for (const auto& row : kept.rows) {
    same += static_cast<std::size_t>(std::count(whole.rows.begin(), whole.rows.end(), row));
  }
  EXPECT_EQ(same, kept.rows.size()) << "with their times: not made again";
}

// `paper` takes minutes even with --quick; this test stops it after its first tables.
TEST_F(Verbs, PaperStopsWhenInterrupted) {
  std::atomic<bool> done = false;
  std::thread signal([&] {
    const auto first = std::filesystem::path(results()) / "quick" / "scenes" / "runs.csv";
    while (!done && !std::filesystem::exists(first)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    if (!done) std::raise(SIGINT);
  });
  const Ended ended = program({"paper", "--quick", "--results", results(), "--jobs", "2"});
  done = true;
  signal.join();
  EXPECT_EQ(ended.status, 130) << ended.err;
  EXPECT_TRUE(exists("quick/tableaus/tableaus.csv"));
  EXPECT_TRUE(exists("quick/tableaus/stability.csv"));
  EXPECT_TRUE(exists("quick/scenes/runs.csv"));
  // The signal may come when the next study, `order`, has begun.
  EXPECT_FALSE(exists("quick/cpu_time/runs.csv")) << "goes on after an interrupt";
  EXPECT_FALSE(exists("quick/report/index.html"));
}

// Every study that `paper` runs can be loaded in both variants and has runs; the quick variant does not have more.
TEST(Studies, LoadInBothVariants) {
  for (const auto& entry : builtinStudies()) {
    const Study full = loadStudy(entry.id, StudyVariant::kFull);
    const Study quick = loadStudy(entry.id, StudyVariant::kQuick);
    const auto count = [](const Study& study) {
      std::size_t runs = 0;
      for (const auto& series : study.series) runs += series.runs.size();
      return runs;
    };
    EXPECT_EQ(full.id, entry.id);
    EXPECT_GT(count(quick), 0u) << entry.id;
    EXPECT_LE(count(quick), count(full)) << entry.id;
    EXPECT_LE(quick.series.size(), full.series.size()) << entry.id;
    EXPECT_FALSE(full.title.empty()) << entry.id;
  }
}

}  // namespace
}  // namespace irk
