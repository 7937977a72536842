// The store of results: nothing that was finished is lost, and no row pretends to be what it is not.
#include "experiments/store/store.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include "experiments/compare/folders.h"
#include "experiments/environment.h"
#include "experiments/numbers.h"
#include "experiments/results.h"
#include "experiments/run_table.h"
#include "experiments/status.h"
#include "experiments/store/failure.h"
#include "experiments/store/merge.h"
#include "experiments/timing.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

using store::Store;
using store::Use;

constexpr char kToml[] = R"(
[[block]]
scene = "kepler"
t_end = 0.5
methods = ["radau_iia_2", "radau_iia_3", "gauss_2"]
tolerances = [1e-3, 1e-4, 1e-5]
)";
// Runs of some milliseconds: some of them, but not all, are finished after a while.
constexpr char kLong[] = R"(
[[block]]
scene = "kepler"
t_end = 60
methods = ["radau_iia_2", "radau_iia_3", "gauss_2", "gauss_3"]
tolerances = [1e-3, 1e-4, 1e-5, 1e-6]
)";

/// A study's folder, and rows made up for it.
class Results : public testing::Test {
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
  Store reader(const std::string& tree = "results") {
    return Store(folder(tree), "small", Use::kRead, {}, told_);
  }
  // Of the one part there is.
  void changePart(const std::string& tree, const std::function<void(Table&)>& change) const {
    const auto parts = partsOf(folder(tree));
    ASSERT_EQ(parts.size(), 1u);
    Table part = readTable(parts.front());
    change(part);
    writeTable(parts.front(), part);
  }
  // As if the first `rows` rows had been made and timed on another machine.
  void moveToOtherMachine(const std::string& tree, std::size_t rows) const {
    changePart(tree, [rows](Table& part) {
      for (std::size_t i = 0; i < rows; ++i) {
        part.rows[i][part.column("environment")] = "abc";
        part.rows[i][part.column("cpu_environment")] = "abc";
      }
    });
    Table environments{{}, environmentColumns(), {thisEnvironment()}};
    environments.rows[0][0] = "abc";
    environments.rows[0][environments.column("cpu")] = "Other processor";
    environments.rows[0][environments.column("host")] = "elsewhere";
    writeTable(folder(tree) / "parts" / "environments.0.csv", environments);
  }

  // By the last `run`, as its progress says; it is silent about nothing.
  int made() const {
    const std::string told = told_.str();
    const auto at = told.find(" runs made");
    return at == told.npos ? 0 : std::stoi(told.substr(told.rfind(' ', at - 1)));
  }

  TemporaryFolder folder_;
  std::ostringstream told_;
};

// A process of its own; its exit status is 0, `f`'s, or 9 after an exception.
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

int exitStatusOf(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::set<std::string> keysOf(const Table& runs) {
  std::set<std::string> keys;
  for (const auto& row : runs.rows) keys.insert(row.front());
  return keys;
}

std::string failureOf(const std::function<void()>& f) {
  try {
    f();
  } catch (const store::StoreFailure& failure) {
    return failure.what();
  }
  ADD_FAILURE() << "nothing failed";
  return {};
}

// Equal but for times, dates and where it was made.
void expectSame(const Table& a, const Table& b) {
  const auto comparison = compare::compareRuns({a, {}}, {b, {}}, {.times = 10});
  EXPECT_TRUE(comparison.differences.empty()) << compare::textOf("", comparison);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) EXPECT_EQ(a.rows[i].front(), b.rows[i].front());
}

// --- One row per line.

TEST(Part, SplitsWhatIsWritten) {
  const TableRow row{"a", "b,c", "say \"x\"", "", "\"", ","};
  std::vector<std::string_view> cells;
  const std::string line = csvLine(row);
  ASSERT_TRUE(store::splitLine(line, cells));
  EXPECT_EQ(store::plainRow(cells), row);
  for (const char* damaged : {"a,\"b,c", "a,b\"c", "\"a\"b,c", "\"", "a,\"\"\""}) {
    EXPECT_FALSE(store::splitLine(damaged, cells)) << damaged;
  }
}

TEST(Part, SecondsOfADate) {
  EXPECT_EQ(store::secondsOf("1970-01-02T00:00:01Z"), 86401u);
  EXPECT_EQ(store::secondsOf("2024-02-29T12:34:56Z"), 1709210096u);  // date -ud 2024-02-29T12:34:56 +%s
  EXPECT_EQ(store::secondsOf(""), 0u);
}

TEST_F(Results, OneDamagedLineCostsOneRow) {
  const Table whole = run();
  const auto part = partsOf(folder()).front();
  std::vector<std::string> lines;
  std::istringstream in(contentsOf(part));
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 10u);
  const auto key = [&](std::size_t line) { return lines[line].substr(0, 16); };
  const std::set<std::string> lost{key(2), key(5), key(9)};
  lines[2].insert(40, "\"");
  lines[5] += ",one cell more";
  lines[9].resize(50);
  {
    std::ofstream out(part, std::ios::binary);
    for (std::size_t i = 0; i < 9; ++i) out << lines[i] << '\n';
    out << lines[9];
  }
  // A reader changes nothing.
  EXPECT_EQ(reader().runs().size(), 6u);
  EXPECT_FALSE(std::filesystem::exists(part.parent_path() / (part.stem().string() + ".damaged")));

  expectSame(run(), whole);
  EXPECT_TRUE(containsAll(told_.str(), {"3 rows cannot be read (lines 3, 6, 10)", ".damaged"}));
  EXPECT_EQ(made(), 3);
  auto aside = part;
  aside.replace_extension(".damaged");
  EXPECT_TRUE(containsAll(contentsOf(aside), {"line 3: " + lines[2], "line 6: " + lines[5], "line 10: " + lines[9]}));
  EXPECT_EQ(keysOf(readTable(partsOf(folder()).back())), lost) << "nothing else is made again";
  run();
  EXPECT_EQ(told_.str().find("cannot be read"), std::string::npos) << "it is said once";
}

TEST_F(Results, PartsOfAnotherVersionStay) {
  run();
  const auto other = folder() / "parts" / "runs.0.csv";
  writeTable(other, {{}, {"key", "scene"}, {{"1", "kepler"}}});
  const auto before = contentsOf(other);
  EXPECT_EQ(run().rows.size(), 9u);
  EXPECT_TRUE(containsAll(told_.str(), {other.string(), "columns"}));
  EXPECT_EQ(made(), 0);
  EXPECT_EQ(contentsOf(other), before);
}

TEST_F(Results, ATableWithoutPartsIsTakenIn) {
  const Table first = run();
  std::filesystem::remove_all(folder() / "parts");
  EXPECT_EQ(run().rows, first.rows);
  EXPECT_TRUE(containsAll(told_.str(), {"taken in"}));
  EXPECT_EQ(made(), 0);
  EXPECT_EQ(partsOf(folder()).size(), 1u);
}

// --- Rows are only added.

TEST_F(Results, AStudyEditedAndEditedBackFindsItsRuns) {
  const Table first = run();
  const std::string edited = R"(
[[block]]
scene = "kepler"
t_end = 0.5
methods = ["gauss_2"]
tolerances = [1e-5, 1e-6]
)";
  const Table other = run("results", {}, edited);
  ASSERT_EQ(other.rows.size(), 2u);
  EXPECT_EQ(made(), 1);
  EXPECT_EQ(run().rows, first.rows);
  EXPECT_EQ(made(), 0);
}

TEST_F(Results, NothingToDoWritesNoPart) {
  run();
  const auto parts = partsOf(folder(), "").size();
  run();
  EXPECT_EQ(partsOf(folder(), "").size(), parts);
}

TEST_F(Results, TheExportIsInTheStudysOrderWhateverThatOfTheParts) {
  const Table first = run();
  changePart("results", [](Table& part) { std::reverse(part.rows.begin(), part.rows.end()); });
  EXPECT_EQ(run().rows, first.rows);
}

// Which of two rows of one key counts, and that the order of the parts does not matter.
TEST_F(Results, TheRowThatCounts) {
  const TableRow made = run().rows.front();
  const Table names{{}, runColumns(), {}};
  const std::string own = textAt(names, made, "code");
  const auto row = [&](const std::string& code, const char* remade, const char* timed, const char* date) {
    TableRow changed = made;
    changed[names.column("code")] = code;
    changed[names.column("remade")] = remade;
    changed[names.column("cpu_runs")] = timed;
    changed[names.column("date")] = date;
    return changed;
  };
  const char *early = "2020-01-01T00:00:00Z", *late = "2021-01-01T00:00:00Z";
  const std::vector<std::pair<TableRow, TableRow>> ranked = {
      {row(own, "", "0", early), row("other", late, "3", late)},  // this code
      {row(own, early, "0", early), row(own, "", "3", late)},     // asked for anew
      {row(own, "", "1", early), row(own, "", "0", late)},        // timed
      {row(own, "", "1", late), row(own, "", "3", early)},        // later
      {row("other", "", "0", late), row("other", "", "0", early)}};
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    const auto& [better, worse] = ranked[i];
    for (const bool better_first : {true, false}) {
      const std::filesystem::path tree = folder_.path() / ("rank" + std::to_string(2 * i + better_first));
      writeTable(tree / "parts" / "runs.1.csv", {{}, runColumns(), {better_first ? better : worse}});
      writeTable(tree / "parts" / "runs.2.csv", {{}, runColumns(), {better_first ? worse : better}});
      const Store read(tree, "small", Use::kRead, {}, told_);
      EXPECT_EQ(read.runs().row(*read.runs().find(store::keyNumber(made.front()))), better) << i << better_first;
    }
  }
}

// --- Two writers, killed writers.

TEST_F(Results, ASecondWriterIsToldWhoWrites) {
  const Store first(folder(), "small", Use::kWrite, {}, told_);
  const auto message = failureOf([&] { run(); });
  EXPECT_TRUE(containsAll(message, {folder().string(), std::to_string(getpid()), hostName(), "--wait", "lock", "20"}));
  EXPECT_EQ(reader().runs().size(), 0u) << "readers are not kept out";
}

TEST_F(Results, ASecondWriterWaits) {
  auto first = std::make_unique<Store>(folder(), "small", Use::kWrite, store::StoreOptions(), told_);
  std::ostringstream told;
  Table runs;
  std::thread second([&] {
    RunnerOptions waiting = options("results", {.if_locked = store::IfLocked::kWait});
    runs = runStudy(study(), waiting, told);
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(rowsInParts(folder()), 0);
  first.reset();
  second.join();
  EXPECT_EQ(runs.rows.size(), 9u);
  EXPECT_TRUE(containsAll(told.str(), {"waiting", std::to_string(getpid())}));
  EXPECT_FALSE(std::filesystem::exists(folder() / "lock"));
}

TEST_F(Results, TheLockOfADeadProcessIsTakenOver) {
  const pid_t child = startProcess([&] {
    std::ostringstream quiet;
    const Store held(folder(), "small", Use::kWrite, {}, quiet);
    _exit(0);  // without removing it
    return 1;
  });
  ASSERT_EQ(exitStatusOf(child), 0);
  ASSERT_TRUE(std::filesystem::exists(folder() / "lock"));
  EXPECT_EQ(run().rows.size(), 9u);
  EXPECT_TRUE(containsAll(told_.str(), {std::to_string(child), "is no more"}));
  // On another host nobody can know.
  std::ofstream(folder() / "lock") << "elsewhere " << child << " 2020-01-01T00:00:00Z\n";
  EXPECT_TRUE(containsAll(failureOf([&] { run(); }), {"elsewhere", "2020-01-01", "remove"}));
}

// Two writers without locks, as where a file system does not keep its promises: no row is lost or torn.
TEST_F(Results, TwoWritersAtOnceLoseNothing) {
  constexpr int kRows = 2000;
  const auto write = [&](std::uint64_t first) {
    store::Rows rows(folder(), "runs", runColumns(), "code");
    RunRecord record;
    record.spec.scene = "kepler";
    record.detail = "a \"detail\", with\na line end";
    for (int i = 0; i < kRows; ++i) rows.append(runRow(hexText(first + static_cast<std::uint64_t>(i)), "small", record));
  };
  const pid_t child = startProcess([&] {
    write(1);
    return 0;
  });
  std::thread other([&] { write(10'000); });
  write(20'000);
  other.join();
  EXPECT_EQ(exitStatusOf(child), 0);
  const Store read = reader();
  EXPECT_EQ(read.runs().size(), 3u * kRows);
  EXPECT_EQ(read.runs().damaged(), 0u);
  EXPECT_EQ(partsOf(folder()).size(), 3u);
}

TEST_F(Results, KilledRunsKeepWhatIsFinished) {
  const Table undisturbed = run("undisturbed", {}, kLong);
  std::set<std::string> finished;
  for (const int rows : {1, 4, 9}) {
    const pid_t child = startProcess([&] {
      std::ostringstream quiet;
      runStudy(study(kLong), options("killed"), quiet);
      return 0;
    });
    while (rowsInParts(folder("killed")) < rows && waitpid(child, nullptr, WNOHANG) == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const Store left = reader("killed");
    EXPECT_GE(left.runs().size(), static_cast<std::size_t>(rows));
    std::set<std::string> now;
    left.runs().forEach([&](const store::Entry& entry) { now.insert(left.runs().line(entry)); });
    EXPECT_TRUE(std::includes(now.begin(), now.end(), finished.begin(), finished.end())) << "with their times";
    finished = now;
  }
  EXPECT_LT(finished.size(), undisturbed.rows.size()) << "the machine is too fast for this test";
  expectSame(run("killed", {}, kLong), undisturbed);
}

// A limit on the length of files stands for a full disk: the row that does not fit is cut.
TEST_F(Results, AFullDiskLosesNoFinishedRun) {
  const Table undisturbed = run("undisturbed");
  const pid_t child = startProcess([&] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4000, 4000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      run();
    } catch (const store::StoreFailure& failure) {
      return containsAll(failure.what(), {"cannot write", "parts"}) ? 7 : 8;
    }
    return 0;
  });
  EXPECT_EQ(exitStatusOf(child), 7);
  const auto kept = reader().runs().size();
  EXPECT_GT(kept, 2u);
  EXPECT_LT(kept, 9u);
  expectSame(run(), undisturbed);
  EXPECT_EQ(static_cast<std::size_t>(made()), 9 - kept);
  EXPECT_TRUE(containsAll(told_.str(), {"1 rows cannot be read"}));
}

// --- Stale rows, environments.

TEST_F(Results, StaleRowsAreKeptOrRemade) {
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
  EXPECT_TRUE(containsAll(contentsOf(folder() / "runs.csv"), {"othercode (4 rows, stale)"}));
  EXPECT_EQ(statusOf(study(), options(), reader()).all.stale, 4u);

  const Table remade = run("results", {.stale = store::StaleRows::kRemake});
  EXPECT_EQ(stale(remade), 0);
  EXPECT_EQ(remade.rows.size(), 9u);
  EXPECT_EQ(made(), 4);
  EXPECT_EQ(rowsInParts(folder()), 13) << "the stale rows stay";
}

TEST_F(Results, FreshRunsCountWhateverWasTimedBefore) {
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

// The head says when and where rows were made, not when they were exported.
TEST_F(Results, TheHeadIsThatOfTheRows) {
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

TEST_F(Results, TimesOfTwoMachinesAreNotJoined) {
  Study costs = study(std::string("targets = [1e-2, 1e-4]\nprofile = true\n") + kToml);
  run();
  moveToOtherMachine("results", 5);
  const Table refused = run();
  const auto refusal = refusedTimes(refused.head);
  EXPECT_TRUE(containsAll(refusal, {"2 processors", "'Other processor' (5 rows, environments abc)", processorName(), "(4 rows",
                                    "--times here", "--fresh"}));
  for (const auto& row : refused.rows) {
    EXPECT_TRUE(std::isnan(numberAt(refused, row, "cpu_s")));
    EXPECT_GT(numberAt(refused, row, "residuals"), 0) << "counters are joined";
    EXPECT_FALSE(std::isnan(numberAt(refused, row, "error")));
  }
  EXPECT_EQ(refusedTimes(folder() / "runs.csv"), refusal);
  writeTable(folder() / "profile.csv", {{}, {"ratio"}, {}});
  EXPECT_EQ(writeSummaries(costs, refused, folder(), told_), std::vector{refusal});
  EXPECT_FALSE(std::filesystem::exists(folder() / "profile.csv"));
  const Table cost = readTable(folder() / "cpu_at_error.csv");
  bool reached = false;
  for (const auto& row : cost.rows) {
    EXPECT_TRUE(std::isnan(numberAt(cost, row, "cpu_s")));
    reached = reached || numberAt(cost, row, "residuals") > 0;
  }
  EXPECT_TRUE(reached);

  // Here: the others' times do not count, and the timing pass measures them again.
  const store::StoreOptions here{.times = store::Times::kHere};
  Table chosen = run("results", here);
  EXPECT_TRUE(refusedTimes(chosen.head).empty());
  EXPECT_EQ(std::count_if(chosen.rows.begin(), chosen.rows.end(),
                          [&](const auto& row) { return std::isnan(numberAt(chosen, row, "cpu_s")); }), 5);
  costs.timing = {true, 1e-4, 2, 0.5, 3};
  {
    Store writer(folder(), "small", Use::kWrite, here, told_);
    timeStudy(costs, writer, chosen, told_);
  }
  const Table timed = run();
  EXPECT_TRUE(refusedTimes(timed.head).empty()) << "all are of this machine now";
  for (const auto& row : timed.rows) {
    EXPECT_EQ(numberAt(timed, row, "cpu_runs"), 2);
    EXPECT_EQ(textAt(timed, row, "cpu_environment"), thisEnvironment().front());
  }
}

// --- The key.

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
  // The name of a method says nothing about its numbers.
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

TEST_F(Results, StatusCountsByScene) {
  const std::string two = std::string(kToml) + R"(
[[block]]
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
  ASSERT_EQ(all.scenes.size(), 2u);
  EXPECT_EQ(all.scenes[0].first, "kepler");
  EXPECT_EQ(all.scenes[0].second.failed, 0u);
  EXPECT_EQ(all.scenes[1].second.finished, 4u);
  EXPECT_EQ(all.scenes[1].second.failed, 2u) << "Lobatto IIIB refuses algebraic unknowns";
  EXPECT_EQ(all.seconds_left, 0);
  EXPECT_TRUE(containsAll(textOf(all), {"all runs are finished"}));
}

TEST_F(Results, StatusOfAPlannedSeriesIsExactWhenItIsFinished) {
  const std::string planned = "[[block]]\nscene = \"riccati_tracking\"\nmethods = \"gauss_2\"\nrefine_most = 40\n";
  EXPECT_EQ(statusOf(study(planned), options(), reader()).all.planned, 11u);
  const Table runs = run("results", {}, planned);
  const auto all = statusOf(study(planned), options(), reader()).all;
  EXPECT_EQ(all.planned, runs.rows.size());
  EXPECT_EQ(all.finished, runs.rows.size());
}

TEST_F(Results, MergeReportsWhatIsMissingForeignAndInConflict) {
  run("a");
  run("b");
  std::string lost;
  changePart("b", [&](Table& part) {
    lost = part.rows.back().front();
    part.rows.pop_back();
    part.rows[0][part.column("newton_iterations")] = "1";
    part.rows[1][part.column("outcome")] = "timeout";  // the clock decides that
    part.rows[2][part.column("code")] = "othercode";   // another version may compute otherwise
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
  EXPECT_TRUE(containsAll(both.conflicts[0].run, {"kepler", "radau_iia_3"}));
  EXPECT_TRUE(containsAll(both.conflicts[0].what, {"newton_iterations", "/ 1", folder("a").string(), folder("b").string()}));
  const auto second = store::reportOf(study(), keys, {&b});
  EXPECT_EQ(second.found, 8u);
  EXPECT_EQ(second.missing, 1u);
  EXPECT_EQ(second.foreign, 3u);
  ASSERT_EQ(second.missing_series.size(), 1u);
  const auto& series = keys[second.missing_series[0]];
  EXPECT_EQ(std::count(series.begin(), series.end(), store::keyNumber(lost)), 1);
}

}  // namespace
}  // namespace irk
