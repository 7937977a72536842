// The verbs that work on studies, each with success and without: run, merge, compare, plot, report,
// claims, paper. In folders of their own, on studies of seconds.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

#include "experiments/commands/cli.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/builtin_studies.h"
#include "experiments/study/study.h"
#include "experiments/study/study_reader.h"
#include "tests/experiments/program.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

// Scenes and formulations as of the built-in study `drift`, whose figures then can be drawn from it.
constexpr char kSmall[] = R"(
title = "Small"
targets = [1e-2, 1e-4]
[defaults]
formulation = ["index2", "ggl"]
methods = ["radau_iia_3", "radau_iia_5"]
tolerances = [1e-3, 1e-5]
[timing]
min_time_s = 0.0005
repetitions = 2
[[block]]
scene = "pendulum"
t_end = 0.5
)";

/// A temporary folder with a study's file and results.
class Verbs : public testing::Test {
 protected:
  void SetUp() override { std::ofstream(study()) << kSmall; }
  std::string study() const { return folder_.path() / "small.toml"; }
  std::string results(const std::string& name = "results") const { return folder_.path() / name; }
  Ended run(const std::string& into = "results", std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"run", study(), "--results", results(into), "--jobs", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return program(arguments);
  }
  Table runs(const std::string& into = "results") const {
    return readTable(std::filesystem::path(results(into)) / "small" / "runs.csv");
  }
  bool exists(const std::string& file) const {
    return std::filesystem::exists(results() + "/" + file);
  }

  TemporaryFolder folder_;
};

TEST_F(Verbs, RunMakesTablesAndAgainKeepsThem) {
  const Ended first = run();
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_TRUE(containsAll(first.out, {"small", "8 runs", "8 success"}));
  const Table table = runs();
  ASSERT_EQ(table.rows.size(), 8u);
  for (const auto& row : table.rows) {
    EXPECT_EQ(textAt(table, row, "outcome"), "success");
    EXPECT_EQ(numberAt(table, row, "cpu_runs"), 2) << "timed";
  }
  EXPECT_TRUE(exists("small/cpu_at_error.csv"));
  ASSERT_EQ(run().status, 0);
  EXPECT_EQ(runs().rows, table.rows);
  ASSERT_EQ(run("results", {"--fresh"}).status, 0);
  EXPECT_NE(runs().rows, table.rows) << "other times";
}

TEST_F(Verbs, RunOfAMistakeIsStatusTwo) {
  std::ofstream(study())
      << "title = \"Small\"\n[[block]]\nscene = \"pendulun\"\nmethods = \"gauss_2\"\n";
  const Ended ended = run();
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(containsAll(ended.err, {"pendulun", "'pendulum'"}));
  EXPECT_EQ(program({"run", results("no_such.toml")}).status, 2);
}

TEST_F(Verbs, AFolderThatCannotBeMadeIsStatusTwo) {
  const std::string file = study() + "/results";  // below a file
  const std::vector<std::string> verbs[] = {{"run", study()}, {"report"}, {"plot", "drift"}};
  for (auto arguments : verbs) {
    arguments.insert(arguments.end(), {"--results", file});
    const Ended ended = program(arguments);
    EXPECT_EQ(ended.status, 2) << arguments[0];
    EXPECT_TRUE(containsAll(ended.err, {"irk: ", file})) << arguments[0];
  }
}

TEST_F(Verbs, OneThreadAndSeveralMakeTheSame) {
  ASSERT_EQ(run("several").status, 0);
  ASSERT_EQ(program({"run", study(), "--results", results("one"), "--jobs", "1"}).status, 0);
  const Ended same = program({"compare", results("one") + "/small", results("several") + "/small", "--times", "1000%"});
  EXPECT_EQ(same.status, 0) << same.out;
  EXPECT_TRUE(containsAll(same.out, {"8 runs and 8 runs: 0 differences"}));
}

// What the limits are: tests/experiments/compare/compare_test.cpp.
TEST_F(Verbs, CompareSeesADifference) {
  ASSERT_EQ(run().status, 0);
  const auto changed = [&](const std::string& column, const char* cell) {
    Table other = runs();
    other.rows.front()[other.column(column)] = cell;
    writeTable(std::filesystem::path(results("other")) / "small" / "runs.csv", other);
    return program({"compare", results() + "/small", results("other") + "/small"});
  };
  for (const auto* column :
       {"error", "error_v", "drift", "residuals", "outcome", "steps_accepted", "cpu_s"}) {
    const Ended ended = changed(column, "123");
    EXPECT_EQ(ended.status, 1) << column;
    EXPECT_TRUE(containsAll(ended.out, {"8 runs and 8 runs: 1 differences", "pendulum"})) << column;
  }
  for (const auto* column : {"key", "detail", "cpu_median_s", "cpu_spread"}) {
    EXPECT_EQ(changed(column, "123").status, 0) << column;
  }
  Table fewer = runs();
  fewer.rows.pop_back();
  writeTable(std::filesystem::path(results("other")) / "small" / "runs.csv", fewer);
  EXPECT_EQ(program({"compare", results() + "/small", results("other") + "/small"}).status, 1);
  EXPECT_EQ(program({"compare", results("other") + "/small", results() + "/small"}).status, 1);
  EXPECT_EQ(program({"compare", results() + "/small", results("nowhere")}).status, 2);
}

TEST_F(Verbs, MergeJoinsShardsToTheWhole) {
  ASSERT_EQ(run("whole").status, 0);
  ASSERT_EQ(run("parts", {"--shard", "1/2"}).status, 0);
  ASSERT_EQ(run("parts", {"--shard", "2/2"}).status, 0);
  const std::string parts = results("parts") + "/small/shard_";
  const Table one = readTable(parts + "1_of_2/runs.csv"),
              two = readTable(parts + "2_of_2/runs.csv");
  EXPECT_EQ(one.rows.size() + two.rows.size(), 8u);
  EXPECT_FALSE(one.rows.empty() || two.rows.empty());
  const Ended merged = program({"merge", parts + "2_of_2", parts + "1_of_2", "--study", study(),
                                "--results", results("merged")});
  ASSERT_EQ(merged.status, 0) << merged.err;
  EXPECT_TRUE(containsAll(merged.out, {"small", "8 runs of 2 folders"}));
  EXPECT_TRUE(std::filesystem::exists(results("merged") + "/small/cpu_at_error.csv"));
  const Ended same =
      program({"compare", results("whole") + "/small", results("merged") + "/small", "--times", "1000%"});
  EXPECT_EQ(same.status, 0) << same.out;
  // In the study's order, whatever that of the folders.
  const Table a = runs("whole"), b = runs("merged");
  for (std::size_t i = 0; i < a.rows.size(); ++i) EXPECT_EQ(a.rows[i].front(), b.rows[i].front());
}

TEST_F(Verbs, MergePrefersWhatIsTimedAndKnowsItsColumns) {
  ASSERT_EQ(run().status, 0);
  Table timed = runs(), untimed = timed;
  for (auto& row : untimed.rows) {
    row[untimed.column("cpu_runs")] = "0";
    row[untimed.column("cpu_s")] = "77";
    row[untimed.column("date")] = "2099-01-01T00:00:00Z";
  }
  const std::string a = results("a"), b = results("b");
  writeTable(std::filesystem::path(a) / "runs.csv", timed);
  writeTable(std::filesystem::path(b) / "runs.csv", untimed);
  for (const auto& order : {std::vector{a, b}, std::vector{b, a}}) {
    const std::string into = results(order[0] == a ? "m" : "n");
    const Ended merged = program({"merge", order[0], order[1], "--study", study(), "--results", into});
    ASSERT_EQ(merged.status, 0) << merged.err;
    EXPECT_TRUE(containsAll(merged.out, {"expected 8, found 8, missing 0, duplicate 8"}));
    for (const auto& row : readTable(into + "/small/runs.csv").rows) EXPECT_NE(row[timed.column("cpu_s")], "77");
  }
  timed.columns.back() = "another";
  writeTable(std::filesystem::path(a) / "runs.csv", timed);
  const Ended refused = program({"merge", a, "--study", study(), "--results", results("o")});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(containsAll(refused.err, {"columns", "no run of this version"}));
}

TEST_F(Verbs, MergeSaysWhatIsMissing) {
  ASSERT_EQ(run("parts", {"--shard", "2/3"}).status, 0);
  const std::string shard = results("parts") + "/small/shard_2_of_3";
  std::vector<std::string> arguments{"merge", shard, "--study", study(), "--results", results("merged")};
  const Ended missing = program(arguments);
  EXPECT_EQ(missing.status, 1);
  EXPECT_TRUE(containsAll(missing.out, {"expected 8, found 2, missing 6",
                                        "irk run " + study() + " --shard 1/3 --results " + results("parts"),
                                        "irk run " + study() + " --shard 3/3 --results " + results("parts")}));
  EXPECT_EQ(missing.out.find("--shard 2/3"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(results("merged") + "/small/runs.csv"));
  arguments.emplace_back("--partial");
  EXPECT_EQ(program(arguments).status, 0);
  EXPECT_EQ(runs("merged").rows.size(), 2u);
  // Rows that are there count: the rest is made where they were merged.
  EXPECT_EQ(run("merged").status, 0);
  EXPECT_EQ(runs("merged").rows.size(), 8u);
}

// The commands that it prints, run as they are, make what is missing.
TEST_F(Verbs, MergePrintsCommandsThatWork) {
  std::vector<std::string> arguments{"run", study(), "--quick", "--results", results("parts"), "--shard", "1/2"};
  ASSERT_EQ(program(arguments).status, 0);
  const auto merged = [&](std::vector<std::string> more) {
    std::vector<std::string> merge{"merge", results("parts") + "/quick/small/shard_1_of_2", "--study", study(), "--quick",
                                   "--results", results("merged")};
    merge.insert(merge.end(), more.begin(), more.end());
    return program(merge);
  };
  const Ended missing = merged({});
  ASSERT_EQ(missing.status, 1);
  const auto at = missing.out.find("  irk run ");
  ASSERT_NE(at, std::string::npos) << missing.out;
  std::istringstream command(missing.out.substr(at + 6));
  arguments.clear();
  for (std::string word; command >> word;) arguments.push_back(word);
  ASSERT_EQ(program(arguments).status, 0) << missing.out;
  const Ended whole = merged({results("parts") + "/quick/small/shard_2_of_2"});
  EXPECT_EQ(whole.status, 0) << whole.out;
  EXPECT_EQ(readTable(results("merged") + "/quick/small/runs.csv").rows.size(), 8u);
}

TEST_F(Verbs, MergeRefusesTwoStudies) {
  ASSERT_EQ(run().status, 0);
  const std::string other = folder_.path() / "other.toml";
  std::ofstream(other) << kSmall;
  ASSERT_EQ(program({"run", other, "--results", results()}).status, 0);
  const Ended ended = program({"merge", results() + "/small", results() + "/other", "--study", study()});
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(containsAll(ended.err, {"two studies", "'small'", "'other'"}));
  const Ended itself = program({"merge", results() + "/small", "--study", study(), "--results", results()});
  EXPECT_EQ(itself.status, 2);
  EXPECT_TRUE(containsAll(itself.err, {"merged there", "leave it out"}));
}

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

// The chain of a paper: run, plot, claims, report.
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
  EXPECT_NE(claims.out.find("C7  "), claims.out.npos);
  const Ended report = program({"report", "--results", results()});
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_TRUE(containsAll(report.out, {"index.html"}));
  std::ifstream in(results() + "/report/index.html");
  const std::string page{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  EXPECT_TRUE(containsAll(page, {"figures/drift_pendulum.svg", "id=\"C7\"", "study_drift"}));
  EXPECT_EQ(page.find("figures/work_slider_crank.svg"), page.npos) << "of a study that was not run";
  EXPECT_EQ(page.find("@CLAIMS@"), page.npos);
  EXPECT_EQ(page.find("@FIGURES@"), page.npos);
}

TEST_F(Verbs, FiguresDoNotJoinTimesOfTwoMachines) {
  ASSERT_EQ(run().status, 0);
  const auto part = partsOf(results() + "/small").front();
  Table rows = readTable(part);
  for (auto& row : rows.rows) {
    if (textAt(rows, row, "formulation") == "ggl") row[rows.column("cpu_environment")] = "elsewhere";
  }
  writeTable(part, rows);
  const Ended refused = run();
  EXPECT_EQ(refused.status, 1);
  EXPECT_TRUE(containsAll(refused.err, {"2 processors", "elsewhere", "--times here"}));
  std::filesystem::rename(results() + "/small", results() + "/drift");
  const Ended plotted = program({"plot", "drift", "--results", results()});
  EXPECT_EQ(plotted.status, 1);
  EXPECT_TRUE(containsAll(plotted.err, {"figures of drift have no times", "2 processors"}));
  const Ended claims = program({"claims", "--results", results()});
  EXPECT_TRUE(containsAll(claims.out, {"study drift: times of 2 processors"}));
  std::filesystem::rename(results() + "/drift", results() + "/small");
  const Ended here = run("results", {"--times", "here"});
  EXPECT_EQ(here.status, 0) << here.err;
  for (const auto& row : runs().rows) EXPECT_EQ(numberAt(rows, row, "cpu_runs"), 2);
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

// The first signal ends the run after the step it is in; what was finished is kept, and the same
// command goes on from there.
TEST_F(Verbs, AnInterruptKeepsFinishedRuns) {
  std::ofstream(study())
      << "title = \"Long\"\n[[block]]\nscene = \"kepler\"\nt_end = 400\n"
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
  for (const auto& row : kept.rows) EXPECT_EQ(textAt(kept, row, "outcome"), "success");
  std::ofstream(study())
      << "title = \"Long\"\n[[block]]\nscene = \"kepler\"\nt_end = 400\n"
         "methods = [\"radau_iia_2\", \"radau_iia_3\", \"gauss_2\", \"gauss_3\", \"gauss_4\"]\n"
         "tolerances = [1e-5, 1e-6, 1e-7, 1e-8]\n";
  ASSERT_EQ(program({"run", study(), "--results", results(), "--jobs", "2"}).status, 0);
  const Table whole = runs();
  ASSERT_EQ(whole.rows.size(), 20u);
  std::size_t same = 0;
  for (const auto& row : kept.rows) {
    same += static_cast<std::size_t>(std::count(whole.rows.begin(), whole.rows.end(), row));
  }
  EXPECT_EQ(same, kept.rows.size()) << "with their times: not made again";
}

// `paper` takes minutes even when it is quick: here it is stopped after its first tables.
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
  EXPECT_FALSE(exists("quick/order/runs.csv")) << "goes on after an interrupt";
  EXPECT_FALSE(exists("quick/report/index.html"));
}

TEST_F(Verbs, PaperRefusesMisuse) {
  EXPECT_EQ(program({"paper", "--jobs", "-1"}).status, 2);
  EXPECT_EQ(program({"paper", "order"}).status, 2) << "takes no study";
}

// What `paper` runs: every study can be loaded in both variants, with something to do, and the
// quick one has not more.
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
    EXPECT_FALSE(full.title.empty()) << entry.id;
  }
}

}  // namespace
}  // namespace irk
