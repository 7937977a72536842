// Stores with synthetic rows, and checks of their contents.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "experiments/compare/folders.h"
#include "experiments/runs/run_table.h"
#include "experiments/store/store.h"
#include "experiments/study/study_reader.h"
#include "experiments/tables/environment.h"
#include "tests/experiments/compared_tables.h"
#include "tests/experiments/study_runs.h"

namespace irk {

using store::Store;
using store::Use;

inline constexpr char kToml[] = R"(
[[block]]
scene = "kepler"
t_end = 0.5
methods = ["radau_iia_2", "radau_iia_3", "gauss_2"]
tolerances = [1e-3, 1e-4, 1e-5]
)";
/// A study's folder with synthetic rows.
class StoredRuns : public testing::Test {
 protected:
  Study study(const std::string& toml = kToml) const { return parseStudy(toml, "small.toml", StudyVariant::kFull); }
  RunnerOptions options(const std::string& tree = "results", store::StoreOptions its = {}) const {
    RunnerOptions options;
    options.results = folder_.path() / tree;
    options.jobs = 1;
    options.store = its;
    return options;
  }
  std::filesystem::path folder(const std::string& tree = "results") const { return folder_.path() / tree / "small"; }
  Table run(const std::string& tree = "results", store::StoreOptions its = {}, const std::string& toml = kToml) {
    told_.str("");
    return runStudy(study(toml), options(tree, its), told_);
  }
  Store reader(const std::string& tree = "results") { return Store(folder(tree), "small", Use::kRead, {}, told_); }
  // Changes the only part of the folder.
  void changePart(const std::string& tree, const std::function<void(Table&)>& change) const {
    const auto parts = partsOf(folder(tree));
    ASSERT_EQ(parts.size(), 1u);
    Table part = readPartTable(parts.front());
    change(part);
    writePartTable(parts.front(), part);
  }
  // Marks the first `rows` rows as made and timed on another machine.
  void moveToOtherMachine(const std::string& tree, std::size_t rows) const {
    moveToOther(tree, rows, {{"cpu", "Other processor"}, {"host", "elsewhere"}});
  }
  // The same, with an environment that differs in these columns.
  void moveToOther(const std::string& tree, std::size_t rows, const std::map<std::string, std::string>& values) const {
    changePart(tree, [rows](Table& part) {
      for (std::size_t i = 0; i < rows; ++i) {
        part.rows[i][part.column("environment")] = "abc";
        part.rows[i][part.column("cpu_environment")] = "abc";
      }
    });
    writeOtherEnvironment(tree, values);
  }
  // The environment of the moved rows: that of this program, except these columns.
  void writeOtherEnvironment(const std::string& tree, const std::map<std::string, std::string>& values) const {
    Table environments{{}, environmentColumns(), {thisEnvironment()}};
    environments.rows[0][0] = "abc";
    for (const auto& [column, value] : values) environments.rows[0][environments.column(column)] = value;
    writePartTable(folder(tree) / "parts" / "environments.0.csv", environments);
  }

  // The number of runs that the last `run` reports as made; 0 if it reports nothing.
  int made() const {
    const std::string told = told_.str();
    const auto at = told.find(" runs made");
    return at == told.npos ? 0 : std::stoi(told.substr(told.rfind(' ', at - 1)));
  }

  TemporaryFolder folder_;
  std::ostringstream told_;
};

inline std::set<std::string> keysOf(const Table& runs) {
  std::set<std::string> keys;
  for (const auto& row : runs.rows) keys.insert(row.front());
  return keys;
}

/// Calls `f` in another process; its exit status is 0, that of `f`, or 9 after an exception.
template <class F>
pid_t startProcess(F&& f) {
  const pid_t child = fork();
  if (child != 0) return child;
  int status = 9;
  try {
    status = f();
  } catch (...) {
  }
  _exit(status);
}

inline int exitStatusOf(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Equal except for times, dates and origin.
inline void expectSame(const Table& a, const Table& b) {
  const auto comparison = compared(a, b, {.times = 10});
  EXPECT_TRUE(comparison.differences.empty()) << compare::textOf("", comparison);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) EXPECT_EQ(a.rows[i].front(), b.rows[i].front());
}

}  // namespace irk
