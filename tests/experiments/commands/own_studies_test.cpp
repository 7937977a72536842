// Own studies and tableaus through run, plot, merge and report.
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/input_file.h"
#include "experiments/runs/run_table.h"
#include "experiments/tables/table.h"
#include "tests/experiments/commands/verbs.h"

namespace irk {
namespace {

class OwnStudies : public Verbs {
 protected:
  void ask(const std::string& figures) const { std::ofstream(study(), std::ios::app) << figures; }
  std::string page() const { return readInputFile(results() + "/report/index.html"); }
};

TEST_F(OwnStudies, AreDrawnAndReportedWithoutTheirFile) {
  ask("[[figure]]\nscript = \"work_by\"\nname = \"ours\"\ntitle = \"Our <figure>\"\ncaption = \"What it says.\"\n"
      "variant = \"method\"\nonly = \"formulation=ggl\"\ncosts = \"residuals\"\n");
  ASSERT_EQ(run().status, 0);
  const Ended plotted = program({"plot", study(), "--results", results()});
  EXPECT_EQ(plotted.status, 0) << plotted.err;
  EXPECT_TRUE(exists("report/figures/small_ours.svg"));
  EXPECT_TRUE(exists("report/figures/small_ours.png"));
  std::filesystem::remove(study());
  std::filesystem::remove_all(results() + "/report");
  EXPECT_EQ(program({"plot", "small", "--results", results()}).status, 0);
  EXPECT_TRUE(exists("report/figures/small_ours.svg"));
  const Ended report = program({"report", "--results", results()});
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_TRUE(containsAll(page(), {"study_small", ">Small<", "Our &lt;figure&gt;", "What it says.",
                                   "figures/small_ours.svg", "../small/runs.csv"}));
}

TEST_F(OwnStudies, HaveFiguresByDefault) {
  ASSERT_EQ(run().status, 0);
  EXPECT_EQ(program({"report", "--results", results()}).status, 0);
  EXPECT_TRUE(exists("report/figures/small_work_by.svg"));
  EXPECT_TRUE(exists("report/figures/small_work_by_2.svg")) << "of the second formulation";
  EXPECT_TRUE(containsAll(page(), {"figures/small_work_by_2.svg", "formulation=ggl"}));
}

TEST_F(OwnStudies, AFileThatChangesAfterTheRunIsDrawnAsItIsNow) {
  ASSERT_EQ(run().status, 0);
  ask("[[figure]]\nscript = \"work_by\"\nname = \"later\"\nvariant = \"method\"\n");
  EXPECT_EQ(program({"plot", study(), "--results", results()}).status, 0);
  EXPECT_TRUE(exists("report/figures/small_later.svg"));
  EXPECT_FALSE(exists("report/figures/small_work_by.svg"));
}

TEST_F(OwnStudies, WithoutResultsAreStatusOne) {
  const Ended ended = program({"plot", study(), "--results", results()});
  EXPECT_EQ(ended.status, 1);
  EXPECT_TRUE(containsAll(ended.err, {"no results of study 'small'", "irk run " + study()}));
}

// Their tables would replace each other. A copy, and a file that was moved, are the same study.
TEST_F(OwnStudies, TwoFilesOfOneNameDoNotShareAFolder) {
  ASSERT_EQ(run().status, 0);
  const Table before = runs();
  const std::filesystem::path other = folder_.path() / "other" / "small.toml";
  std::filesystem::create_directories(other.parent_path());
  std::ofstream(other) << kSmall << "max_steps = 5\n";
  const std::vector<std::string> run_other{"run", other, "--results", results()};
  const Ended refused = program(run_other);
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(containsAll(refused.err, {results() + "/small", study(), other, "same name", "--results"}));
  EXPECT_EQ(runs().rows, before.rows);
  std::filesystem::copy_file(study(), other, std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(program(run_other).status, 0);
  std::ofstream(study(), std::ios::app) << "max_steps = 5\n";
  EXPECT_EQ(run().status, 2) << "the copy has been run last";
  std::filesystem::remove(other);
  EXPECT_EQ(run().status, 0);
}

TEST_F(OwnStudies, MergedShardsHaveTheirFigures) {
  ASSERT_EQ(run("parts", {"--shard", "1/2"}).status, 0);
  ASSERT_EQ(run("parts", {"--shard", "2/2"}).status, 0);
  std::vector<std::string> merge{"merge", "--study", study(), "--results", results()};
  for (const auto& entry : std::filesystem::directory_iterator(results("parts") + "/small")) {
    if (!entry.is_directory()) continue;
    merge.push_back(entry.path());
  }
  const Ended merged = program(merge);
  ASSERT_EQ(merged.status, 0) << merged.err << merged.out;
  EXPECT_EQ(program({"plot", "small", "--results", results()}).status, 0);
  EXPECT_TRUE(exists("report/figures/small_work_by.svg"));
}

TEST_F(OwnStudies, AFigureThatFailsIsStatusOne) {
  ask("[[figure]]\nscript = \"work_by\"\nvariant = \"method\"\nonly = \"formulation=index3\"\n");
  ASSERT_EQ(run().status, 0);
  const Ended plotted = program({"plot", "small", "--results", results()});
  EXPECT_EQ(plotted.status, 1);
  EXPECT_TRUE(containsAll(plotted.err, {"small_work_by", "no rows"}));
  EXPECT_EQ(program({"report", "--results", results()}).status, 1);
  // The runs' table without a column that the script needs.
  Table damaged = runs();
  damaged.columns[damaged.column("formulation")] = "formulatio";
  writeTable(std::filesystem::path(results()) / "small" / "runs.csv", damaged);
  const Ended failed = program({"plot", "small", "--results", results()});
  EXPECT_EQ(failed.status, 1);
  EXPECT_TRUE(containsAll(failed.err, {"gnuplot ended with status"}));
}

TEST_F(OwnStudies, MistakesInFiguresAreMisuseBeforeAnyRun) {
  ask("[[figure]]\nscript = \"work_bye\"\n");
  const Ended ended = run();
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(containsAll(ended.err, {"small.toml:", "'work_by'"}));
  EXPECT_FALSE(exists("small/runs.csv"));
}

// Both files say nothing of a family, so it is `user` for both, with one stage.
TEST_F(OwnStudies, TableausOfOneFamilyStayApart) {
  const auto write = [&](const std::string& name, const std::string& a) {
    std::ofstream(folder_.path() / name) << "stages: 1\norder: 1\nstage_order: 1\nA\n"
                                         << a << "\nb\n1\nc\n"
                                         << a << "\n";
    return (folder_.path() / name).string();
  };
  const auto implicit = write("implicit.txt", "1"), theta = write("theta.txt", "0.6");
  std::ofstream(study()) << "orders = true\ntargets = [1e-2]\n[[block]]\nscene = \"riccati_tracking\"\nmethods = [\""
                         << implicit << "\", \"" << theta << "\"]\nrefine_most = 128\n";
  ASSERT_EQ(run().status, 0);
  for (const auto* name : {"orders.csv", "cpu_at_error.csv"}) {
    const Table table = readTable(std::filesystem::path(results()) / "small" / name);
    std::vector<std::string> methods;
    for (const auto& row : table.rows) methods.push_back(textAt(table, row, "method"));
    EXPECT_EQ(methods, (std::vector<std::string>{implicit, theta})) << name;
  }
  EXPECT_EQ(program({"report", "--results", results()}).status, 0);
  EXPECT_TRUE(containsAll(page(), {implicit, theta})) << "the table of orders";
}

}  // namespace
}  // namespace irk
