// Two writers, killed writers: no finished run is lost.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

#include "experiments/base/numbers.h"
#include "experiments/store/store.h"
#include "tests/experiments/stored_runs.h"
#include "tests/refusal.h"

namespace irk {
namespace {

class Writers : public StoredRuns {};

// Runs of some milliseconds: after a while some of them are finished, but not all.
constexpr char kLong[] = R"(
[[block]]
scene = "kepler"
t_end = 60
methods = ["radau_iia_2", "radau_iia_3", "gauss_2", "gauss_3"]
tolerances = [1e-3, 1e-4, 1e-5, 1e-6]
)";

TEST_F(Writers, ASecondWriterIsToldWhoWrites) {
  const Store first(folder(), "small", Use::kWrite, {}, told_);
  const auto message = failureOf([&] { run(); });
  EXPECT_TRUE(containsAll(message, {folder().string(), std::to_string(getpid()), hostName(), "--wait", "20"}));
  EXPECT_TRUE(containsAll(store::writerIn(folder()), {std::to_string(getpid()), hostName(), "writes there since 20"}));
  EXPECT_EQ(reader().runs().size(), 0u) << "readers are not kept out";
}

TEST_F(Writers, ASecondWriterWaits) {
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
  EXPECT_EQ(store::writerIn(folder()), "");
}

// Whatever the file says.
TEST_F(Writers, TheLockOfADeadProcessIsFree) {
  const pid_t child = startProcess([&] {
    std::ostringstream quiet;
    const Store held(folder(), "small", Use::kWrite, {}, quiet);
    kill(getpid(), SIGKILL);
    return 1;
  });
  siginfo_t info;
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT), 0);
  EXPECT_TRUE(containsAll(readInputFile(folder() / "lock"), {std::to_string(child)}));
  EXPECT_EQ(store::writerIn(folder()), "");
  EXPECT_EQ(run().rows.size(), 9u) << "while its parent has not asked for its status";
  EXPECT_EQ(exitStatusOf(child), -1);
}

// A writer is killed, or starts, between locking the file and writing into it.
TEST_F(Writers, AnEmptyLockHasAHolderOrNone) {
  std::filesystem::create_directories(folder());
  {
    FileLock other(folder() / "lock");
    ASSERT_EQ(other.take(), FileLock::State::kTaken);
    EXPECT_TRUE(containsAll(failureOf([&] { run(); }), {"another process writes there", "--wait"}));
  }
  EXPECT_EQ(run().rows.size(), 9u);
}

// Devices may have no end, and a pipe waits for its writer.
TEST_F(Writers, ALockThatIsADeviceIsRefused) {
  std::filesystem::create_directories(folder());
  std::filesystem::create_symlink("/dev/null", folder() / "lock");
  const auto message = refusal([&] { run(); });
  EXPECT_TRUE(containsAll(message, {"lock", "a device", "regular file"})) << message;
}

// In a folder that is shared, somebody may have put a link there.
TEST_F(Writers, ALockThatIsALinkIsRefused) {
  std::filesystem::create_directories(folder());
  const auto target = folder_.path() / "precious";
  std::ofstream(target) << "kept";
  std::filesystem::create_symlink(target, folder() / "lock");
  EXPECT_TRUE(containsAll(failureOf([&] { run(); }), {"cannot open", "lock"}));
  EXPECT_EQ(readInputFile(target), "kept");
}

// Two writers without locks, as on a file system whose locks do not work: no row is lost or torn.
TEST_F(Writers, TwoWritersAtOnceLoseNothing) {
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

TEST_F(Writers, KilledRunsKeepWhatIsFinished) {
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
    left.runs().forEach([&](const store::Entry& entry) { now.insert(left.runs().csv(entry)); });
    EXPECT_TRUE(std::includes(now.begin(), now.end(), finished.begin(), finished.end())) << "with their times";
    finished = now;
  }
  EXPECT_LT(finished.size(), undisturbed.rows.size()) << "the machine is too fast for this test";
  expectSame(run("killed", {}, kLong), undisturbed);
}

// A limit on the file size stands for a full disk: the row that does not fit is cut short.
TEST_F(Writers, AFullDiskLosesNoFinishedRun) {
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
