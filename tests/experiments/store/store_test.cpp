// The store of results never loses finished runs, whoever writes and whatever is damaged.
#include "experiments/store/store.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

#include "experiments/base/numbers.h"
#include "tests/experiments/stored_runs.h"

namespace irk {
namespace {

class Results : public StoredRuns {};

// Runs of some milliseconds: after a while some of them are finished, but not all.
constexpr char kLong[] = R"(
[[block]]
scene = "kepler"
t_end = 60
methods = ["radau_iia_2", "radau_iia_3", "gauss_2", "gauss_3"]
tolerances = [1e-3, 1e-4, 1e-5, 1e-6]
)";

// Calls `f` in another process; its exit status is 0, that of `f`, or 9 after an exception.
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
  // Reading changes nothing.
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

std::vector<store::Entry> entriesOf(const Store& store) {
  std::vector<store::Entry> entries;
  store.runs().forEach([&entries](const store::Entry& entry) { entries.push_back(entry); });
  return entries;
}

bool isBefore(const store::Entry& a, const store::Entry& b) { return a.offset < b.offset; }

// In any order of reading, an exported row is its line: the same as that of its cells.
TEST_F(Results, RowsAreExportedAsTheyAreWritten) {
  run();
  changePart("results", [](Table& part) {
    part.rows[1][part.column("detail")] = "say \"x\", twice";
    part.rows[4][part.column("detail")] = std::string(100'000, ',');  // longer than what is read at once
    part.rows[8].back() = "\"";
  });
  const std::string text = contentsOf(partsOf(folder()).front());
  const Store store = reader();
  auto entries = entriesOf(store);
  ASSERT_EQ(entries.size(), 9u);
  for (const std::string order : {"of keys", "of the file", "backwards"}) {
    SCOPED_TRACE(order);
    if (order == "of the file") std::sort(entries.begin(), entries.end(), isBefore);
    if (order == "backwards") std::reverse(entries.begin(), entries.end());
    for (const auto& entry : entries) {
      const std::string line = text.substr(entry.offset, text.find('\n', entry.offset) - entry.offset);
      EXPECT_EQ(store.runs().line(entry), line);
      EXPECT_EQ(store.runs().csv(entry), line);
      EXPECT_EQ(csvLine(store.runs().row(entry)), line);
    }
  }
}

TEST_F(Results, RowsThatChangedSinceTheyWereReadAreNotExported) {
  run();
  const auto part = partsOf(folder()).front();
  const std::string text = contentsOf(part);
  const auto write = [&part](const std::string& its) { std::ofstream(part, std::ios::binary) << its; };
  const Store changed = reader(), cut = reader();
  const auto entries = entriesOf(changed);
  const auto last = *std::max_element(entries.begin(), entries.end(), isBefore);
  std::string other = text;
  other[last.offset + 20] = '"';
  write(other);
  EXPECT_TRUE(containsAll(failureOf([&] { (void)changed.runs().csv(last); }), {"changed since it was read"}));
  write(text.substr(0, last.offset + 20));
  EXPECT_TRUE(containsAll(failureOf([&] { (void)cut.runs().csv(last); }), {"shorter than before"}));
}

// --- Rows are only appended.

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

// Which of two rows with one key is valid, regardless of the order of the parts.
TEST_F(Results, TheRowThatCounts) {
  TableRow made = run().rows.front();
  made.resize(runColumns().size());  // parts have no column of blocks
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
      {row(own, early, "0", early), row(own, "", "3", late)},     // requested again
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
    _exit(0);  // without removing the lock
    return 1;
  });
  ASSERT_EQ(exitStatusOf(child), 0);
  ASSERT_TRUE(std::filesystem::exists(folder() / "lock"));
  EXPECT_EQ(run().rows.size(), 9u);
  EXPECT_TRUE(containsAll(told_.str(), {std::to_string(child), "is no more"}));
  // It is unknown whether a process on another host still exists.
  std::ofstream(folder() / "lock") << "elsewhere " << child << " 2020-01-01T00:00:00Z\n";
  EXPECT_TRUE(containsAll(failureOf([&] { run(); }), {"elsewhere", "2020-01-01", "remove"}));
}

// Two writers without locks, as on a file system whose locks do not work: no row is lost or torn.
TEST_F(Results, TwoWritersAtOnceLoseNothing) {
  constexpr int kRows = 2000;
  const auto write = [&](std::uint64_t first) {
    store::Rows rows(folder(), "runs", runColumns(), "code");
    RunRecord record;
    record.spec.scene = "kepler";
    record.detail = "a \"detail\", with\na line end";
    for (int i = 0; i < kRows; ++i)
      rows.append(runRow(hexText(first + static_cast<std::uint64_t>(i)), "small", record));
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

// A limit on the file size stands for a full disk: the row that does not fit is cut short.
TEST_F(Results, AFullDiskLosesNoFinishedRun) {
  const Table undisturbed = run("undisturbed");
  const pid_t child = startProcess([&] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4000, 4000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      run();
    } catch (const Failure& failure) {
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

}  // namespace
}  // namespace irk
