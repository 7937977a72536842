// Rows of other code, of other machines and from several folders: their origin is reported, and incompatible ones are
// not joined.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/analyses/results.h"
#include "experiments/runner/merge.h"
#include "experiments/runner/status.h"
#include "experiments/runner/timing.h"
#include "experiments/study/series_walk.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/stored_runs.h"

namespace irk {
namespace {

class Origin : public StoredRuns {};

// --- Stale rows, environments.

TEST_F(Origin, StaleRowsAreKeptOrRemade) {
  run();
  changePart("results", [](Table& part) {
    for (std::size_t i = 0; i < 4; ++i) {
      part.rows[i][part.column("code")] = "othercode";
      part.rows[i][part.column("residuals")] = "1234567";
    }
  });
  const auto stale = [](const Table& runs) {
    return std::count_if(runs.rows.begin(), runs.rows.end(), [&](const auto& row) {
      return textAt(runs, row, "code") == "othercode" && textAt(runs, row, "residuals") == "1234567";
    });
  };
  const Table kept = run();
  EXPECT_EQ(stale(kept), 4);
  EXPECT_TRUE(containsAll(told_.str(), {"4 runs were made by other code", "--stale remake"}));
  EXPECT_EQ(made(), 0);
  EXPECT_TRUE(containsAll(readInputFile(folder() / "runs.csv"), {"othercode (4 rows, stale)"}));
  EXPECT_EQ(statusOf(study(), options(), reader()).all.stale, 4u);

  const Table remade = run("results", {.stale = store::StaleRows::kRemake});
  EXPECT_EQ(stale(remade), 0);
  EXPECT_EQ(remade.rows.size(), 9u);
  EXPECT_EQ(made(), 4);
  EXPECT_EQ(rowsInParts(folder()), 13) << "the stale rows stay";
}

TEST_F(Origin, FreshRunsCountWhateverWasTimedBefore) {
  run();
  changePart("results", [](Table& part) {
    for (auto& row : part.rows) row[part.column("cpu_runs")] = "3";
    for (auto& row : part.rows) row[part.column("cpu_s")] = "77";
  });
  ASSERT_EQ(textAt(run(), run().rows.front(), "cpu_s"), "77");
  run("results", {.finished = store::FinishedRuns::kRunAgain});
  const Table again = run();
  EXPECT_EQ(made(), 0);
  for (const auto& row : again.rows) EXPECT_NE(textAt(again, row, "cpu_s"), "77");
}

// Whoever reads a table of a quick run must see that it is one.
TEST_F(Origin, TheHeadOfAQuickRunSaysSo) {
  const auto isQuick = [](const Table& table) {
    return std::any_of(table.head.begin(), table.head.end(), [](const auto& entry) { return entry.first == "quick"; });
  };
  EXPECT_TRUE(isQuick(run("quick")));
  EXPECT_FALSE(isQuick(run("results")));
}

// The head of a table tells when and where its rows were made, not when they were exported.
TEST_F(Origin, TheHeadIsThatOfTheRows) {
  run();
  changePart("results", [](Table& part) {
    for (auto& row : part.rows) row[part.column("date")] = "2020-01-01T00:00:00Z";
    part.rows[3][part.column("date")] = "2021-06-01T00:00:00Z";
  });
  moveToOtherMachine("results", 9);
  const Table runs = run();
  const std::map<std::string, std::string> head(runs.head.begin(), runs.head.end());
  EXPECT_EQ(head.at("cpu"), "Other processor");
  EXPECT_EQ(head.at("host"), "elsewhere");
  EXPECT_EQ(head.at("date"), "2020-01-01T00:00:00Z to 2021-06-01T00:00:00Z");
  EXPECT_EQ(statusOf(study(), options(), reader()).all.foreign, 9u);
}

TEST_F(Origin, TimesOfTwoMachinesAreNotJoined) {
  Study costs = study(std::string("targets = [1e-2, 1e-4]\nprofile = true\n") + kToml);
  run();
  moveToOtherMachine("results", 5);
  const Table refused = run();
  const auto refusal = refusedTimes(refused.head);
  EXPECT_TRUE(containsAll(refusal, {"2 timing classes", "'Other processor; ", "(5 rows, environments abc)",
                                    processorName(), "(4 rows", "--times here", "--fresh"}));
  for (const auto& row : refused.rows) {
    EXPECT_TRUE(std::isnan(numberAt(refused, row, "cpu_s")));
    EXPECT_GT(numberAt(refused, row, "residuals"), 0) << "counters are joined";
    EXPECT_FALSE(std::isnan(numberAt(refused, row, "error")));
  }
  EXPECT_EQ(refusedTimes(folder() / "runs.csv"), refusal);
  writeTable(folder() / "profile.csv", {{}, {"ratio"}, {}});
  writeSummaries(costs, refused, folder(), told_);
  EXPECT_FALSE(std::filesystem::exists(folder() / "profile.csv"));
  const Table cost = readTable(folder() / "cpu_at_error.csv");
  bool reached = false;
  for (const auto& row : cost.rows) {
    EXPECT_TRUE(std::isnan(numberAt(cost, row, "cpu_s")));
    reached = reached || numberAt(cost, row, "residuals") > 0;
  }
  EXPECT_TRUE(reached);

  // With kHere the times of other processors do not count, and the timing pass measures them again.
  const store::StoreOptions here{.times = store::Times::kHere};
  Table chosen = run("results", here);
  EXPECT_TRUE(refusedTimes(chosen.head).empty());
  EXPECT_EQ(std::count_if(chosen.rows.begin(), chosen.rows.end(),
                          [&](const auto& row) { return std::isnan(numberAt(chosen, row, "cpu_s")); }),
            5);
  costs.timing = {true, 1e-4, 2, 0.5, 3};
  {
    Store writer(folder(), "small", Use::kWrite, here, told_);
    const RunKeys keys = runKeys(costs, {});
    timeStudy(costs, keys, writer, {}, told_);
    writer.exportTables(keys);
  }
  const Table timed = run();
  EXPECT_TRUE(refusedTimes(timed.head).empty()) << "all are of this machine now";
  for (const auto& row : timed.rows) {
    EXPECT_EQ(numberAt(timed, row, "cpu_runs"), 2);
    EXPECT_EQ(textAt(timed, row, "cpu_environment"), thisEnvironment().front());
  }
}

// --- The key.

// The library of another integrator belongs to the class of its own rows: a study that compares several has several
// classes, whatever program has made them. Another version of the library is another matter.
TEST_F(Origin, TimesOfDifferentLibrariesAreJoined) {
  const std::string toml =
      "[[block]]\nscene = \"kepler\"\nt_end = 0.5\nformulation = \"index1\"\n"
      "methods = [\"radau_iia_2\", \"cvode_bdf\"]\ntolerances = [1e-3, 1e-4]\n";
  const auto refusalWith = [&](const std::string& tree, const std::map<std::string, std::string>& values) {
    run(tree, {}, toml);
    moveToOther(tree, 4, values);  // all rows
    changePart(tree, [](Table& part) {
      for (const std::size_t i : {0u, 2u}) {  // one of each method is of this program again
        for (const char* column : {"environment", "cpu_environment"}) {
          part.rows[i][part.column(column)] = thisEnvironment().front();
        }
      }
    });
    return refusedTimes(run(tree, {}, toml).head);
  };
  EXPECT_EQ(refusalWith("newer", {{"commit", "0123456"}}), "");
  const Table environments{{}, environmentColumns(), {thisEnvironment()}};
  std::string libraries = textAt(environments, environments.rows[0], "libraries");
  const auto at = libraries.find("SUNDIALS ");
  ASSERT_NE(at, std::string::npos);
  libraries.insert(at + 9, "99.");
  const std::string refusal = refusalWith("other_sundials", {{"libraries", libraries}});
  EXPECT_TRUE(containsAll(refusal, {"2 timing classes", "SUNDIALS 99.", "(1 rows, environments abc)"})) << refusal;
}

TEST(Key, HoldsDefaultsAndCoefficients) {
  RunSpec spec;
  spec.scene = "slider_crank";
  spec = resolved(spec);
  auto parameters = findScene("slider_crank").parameters;
  const auto text = keyText(spec, parameters);
  for (const auto& parameter : parameters) {
    EXPECT_TRUE(containsAll(text, {";" + parameter.name + "=" + parameter.default_value}));
  }
  parameters.front().default_value += "1";
  EXPECT_NE(keyText(spec, parameters), text) << "the scene's default has changed";
  // The key depends on a method's coefficients, not on its name.
  const auto coefficients = [&](const char* method) {
    spec.method = method;
    const auto its = keyText(spec, {});
    return its.substr(its.rfind("coefficients="));
  };
  EXPECT_NE(coefficients("radau_iia_3"), coefficients("radau_ia_3"));
  EXPECT_EQ(coefficients("radau_iia_1"), coefficients("radau_iia_1"));
  EXPECT_EQ(coefficients("cvode_bdf"), "coefficients=");
  EXPECT_GT(coefficients("radau_iia_3").size(), std::string("coefficients=").size());
}

// --- Status and merge.

TEST_F(Origin, StatusCountsByBlock) {
  const std::string two = std::string(kToml) + R"(
[[block]]
name = "constrained"
scene = "pendulum"
t_end = 0.1
methods = ["lobatto_iiib_3", "radau_iia_2"]
tolerances = [1e-3, 1e-4]
)";
  const StudyStatus nothing = statusOf(study(two), options(), reader());
  EXPECT_EQ(nothing.all.planned, 13u);
  EXPECT_EQ(nothing.all.finished, 0u);
  EXPECT_TRUE(containsAll(textOf(nothing), {"13 runs to make", "unknown"}));
  EXPECT_FALSE(std::filesystem::exists(folder())) << "status writes nothing";

  run();
  const StudyStatus half = statusOf(study(two), options(), reader());
  EXPECT_EQ(half.all.finished, 9u);
  EXPECT_EQ(half.guessed, 4u) << "no run of the pendulum is finished";
  EXPECT_GT(half.seconds_left, 0);

  run("results", {}, two);
  const StudyStatus all = statusOf(study(two), options(), reader());
  ASSERT_EQ(all.parts.size(), 2u);
  EXPECT_EQ(all.parts[0].first, "block_1");
  EXPECT_EQ(all.parts[0].second.failed, 0u);
  EXPECT_EQ(all.parts[1].first, "constrained");
  EXPECT_EQ(all.parts[1].second.finished, 4u);
  EXPECT_EQ(all.parts[1].second.failed, 2u) << "Lobatto IIIB refuses algebraic unknowns";
  EXPECT_EQ(all.seconds_left, 0);
  EXPECT_TRUE(containsAll(textOf(all), {"all runs are finished"}));
}

TEST_F(Origin, StatusOfAPlannedSeriesIsExactWhenItIsFinished) {
  const std::string planned = "[[block]]\nscene = \"riccati_tracking\"\nmethods = \"gauss_2\"\nrefine_most = 40\n";
  EXPECT_EQ(statusOf(study(planned), options(), reader()).all.planned, kPlannedRuns) << "an estimate";
  const Table runs = run("results", {}, planned);
  const auto all = statusOf(study(planned), options(), reader()).all;
  EXPECT_EQ(all.planned, runs.rows.size());
  EXPECT_EQ(all.finished, runs.rows.size());
}

TEST_F(Origin, MergeReportsWhatIsMissingForeignAndInConflict) {
  run("a");
  run("b");
  std::string lost, changed;
  changePart("b", [&](Table& part) {
    changed = part.rows[0].front();
    lost = part.rows.back().front();
    part.rows.pop_back();
    part.rows[0][part.column("newton_iterations")] = "1";
    part.rows[1][part.column("outcome")] = "timeout";  // timeouts depend on the clock
    part.rows[2][part.column("code")] = "othercode";   // another version may compute other numbers
    part.rows[2][part.column("newton_iterations")] = "1";
    part.rows.push_back(part.rows[3]);
    part.rows.back().front() = "123";
  });
  moveToOtherMachine("b", 3);
  const Store a = reader("a"), b = reader("b");
  const RunKeys keys = runKeys(study(), {});
  const auto both = store::reportOf(study(), keys, {&a, &b});
  EXPECT_EQ(both.expected, 9u);
  EXPECT_EQ(both.found, 9u);
  EXPECT_EQ(both.duplicate, 8u);
  EXPECT_EQ(both.not_of_study, 1u);
  EXPECT_EQ(both.foreign, 0u);
  ASSERT_EQ(both.conflicts.size(), 1u);
  EXPECT_TRUE(containsAll(both.conflicts[0].run, {"kepler", changed}));
  EXPECT_TRUE(
      containsAll(both.conflicts[0].what, {"newton_iterations", "/ 1", folder("a").string(), folder("b").string()}));
  const auto second = store::reportOf(study(), keys, {&b});
  EXPECT_EQ(second.found, 8u);
  EXPECT_EQ(second.missing, 1u);
  EXPECT_EQ(second.foreign, 3u);
  ASSERT_EQ(second.missing_series.size(), 1u);
  const auto series = keys[second.missing_series[0]];
  EXPECT_EQ(std::count(series.begin(), series.end(), store::keyNumber(lost)), 1);
}

}  // namespace
}  // namespace irk
