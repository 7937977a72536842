// Several processes make one study: ranks started by mpirun.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>
#include <thread>

#include "experiments/runner/ranks.h"
#include "tests/experiments/stored_runs.h"

namespace irk {
namespace {

// Each run of a series that is planned run by run: a thread waits until the run before is recorded.
TEST(WorkQueue, GivesEachPieceOnce) {
  const Study study = parseStudy(
      "orders = true\n[[block]]\nscene = \"kepler\"\nmethods = [\"gauss_1\", \"gauss_2\"]\nrefine_most = 40\n",
      "small.toml", StudyVariant::kFull);
  const auto schedule = [&] {
    const auto costs = [&](std::size_t i) { return std::vector<double>(study.series[i].runs.size(), 1); };
    return Schedule(study, {0, 1},
                    {costs, [](std::size_t, std::size_t) { return std::optional<RunFacts>(); }, [](std::size_t) {}});
  };
  const auto queue = aloneRank()->queue(schedule, {});
  std::mutex mutex;
  std::multiset<std::pair<std::size_t, std::size_t>> given;
  const auto take = [&] {
    while (const auto piece = queue->next()) {
      {
        const std::lock_guard lock(mutex);
        given.emplace(piece->series, piece->run);
      }
      const double error = 1e-3 / static_cast<double>((piece->run + 1) * (piece->run + 1));
      queue->record(*piece, {"success", {error, error, error, error}});
    }
  };
  std::thread other(take), third(take);
  take();
  other.join();
  third.join();
  EXPECT_GE(given.size(), 10u);
  EXPECT_EQ(std::set(given.begin(), given.end()).size(), given.size());
  EXPECT_EQ(given.count({0, 0}), 1u);
  EXPECT_EQ(given.count({1, 0}), 1u);
  EXPECT_FALSE(queue->next());
}

TEST(TimingRanks, AreOnePerHost) {
  EXPECT_EQ(timingRanks({"a"}), (std::vector<int>{0}));
  EXPECT_EQ(timingRanks({"a", "a", "a", "a"}), (std::vector<int>{0}));
  EXPECT_EQ(timingRanks({"a", "a", "b", "a", "c", "b"}), (std::vector<int>{0, 2, 4}));
}

#ifdef IRK_MPIEXEC

constexpr char kRankStudy[] = R"(
[[block]]
scene = ["kepler", "van_der_pol"]
methods = ["radau_iia_2", "radau_iia_3", "gauss_2", "radau_iia_5", "lobatto_iiic_3", "gauss_5"]
tolerances = [1e-4, 1e-7, 1e-10]
)";

class RanksOfMpi : public StoredRuns {
 protected:
  void SetUp() override {
    std::ofstream(folder_.path() / "small.toml") << kRankStudy;
    // Settings for Open MPI: allow root, and more ranks than cores.
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 1);
    setenv("OMP_NUM_THREADS", "1", 1);
  }
  std::string command(const std::string& tree, const std::string& before = "") const {
    const std::string path = folder_.path().string();
    return before + " " IRK_PROGRAM " run " + path + "/small.toml --results " + path + "/" + tree + " > " + path + "/" +
           tree + ".out 2>&1";
  }
  std::string output(const std::string& tree) const { return readInputFile(folder_.path() / (tree + ".out")); }
  static int statusOf(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::size_t partsWithRuns(const std::string& tree) const {
    std::size_t parts = 0;
    for (const auto& part : partsOf(folder(tree))) parts += readTable(part).rows.empty() ? 0u : 1u;
    return parts;
  }
  Table exported(const std::string& tree) const { return readTable(folder(tree) / "runs.csv"); }
};

const std::string kFour = IRK_MPIEXEC " -n 4";

TEST_F(RanksOfMpi, FourMakeTheSameTableAsOne) {
  ASSERT_EQ(statusOf(command("one")), 0) << output("one");
  ASSERT_EQ(statusOf(command("four", kFour)), 0) << output("four");
  EXPECT_GE(partsWithRuns("four"), 2u) << output("four");
  EXPECT_EQ(partsWithRuns("one"), 1u);
  const Table one = exported("one");
  EXPECT_EQ(one.rows.size(), 36u);
  expectSame(exported("four"), one);
  EXPECT_EQ(rowsInParts(folder("four")), 36) << "a run was made twice";
  ASSERT_EQ(statusOf(command("four", kFour)), 0);
  EXPECT_EQ(rowsInParts(folder("four")), 36) << "there was nothing left to make";
}

TEST_F(RanksOfMpi, FourSkipTheSameRunsAsOne) {
  std::ofstream(folder_.path() / "small.toml") << R"(
[defaults]
max_steps = 60
tolerances = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9]
[[block]]
scene = ["kepler", "van_der_pol"]
configuration = "embedded"
methods = ["radau_iia_2", "radau_iia_3", "gauss_2"]
)";
  ASSERT_EQ(statusOf(command("one")), 0) << output("one");
  ASSERT_EQ(statusOf(command("four", kFour)), 0) << output("four");
  const Table one = exported("one");
  EXPECT_EQ(one.rows.size(), 48u);
  EXPECT_NE(readInputFile(folder("one") / "runs.csv").find("not run: "), std::string::npos);
  expectSame(exported("four"), one);
}

// srun sets these; whether the processes know of each other depends on how Slurm and MPI were built.
TEST_F(RanksOfMpi, ProcessesThatDoNotKnowOfEachOtherAreRefused) {
  const std::string srun = "SLURM_STEP_NUM_TASKS=3 SLURM_PROCID=1";
  EXPECT_EQ(statusOf(command("alone", srun)), 2) << output("alone");
  EXPECT_TRUE(containsAll(output("alone"), {"SLURM_STEP_NUM_TASKS = 3", "--mpi", "mpirun"}));
  EXPECT_EQ(statusOf(command("one", "SLURM_STEP_NUM_TASKS=1 SLURM_PROCID=0")), 0) << output("one");
  EXPECT_EQ(statusOf(command("batch", "SLURM_NTASKS=3 SLURM_PROCID=0")), 0) << "a batch script is no step of srun";
}

// Each rank has a folder of its own, as with results on a host's own disk.
TEST_F(RanksOfMpi, RowsThatAreElsewhereAreMissed) {
  const std::string tree = folder_.path() / "local_";
  std::ofstream(folder_.path() / "rank.sh") << "exec " IRK_PROGRAM " run " << (folder_.path() / "small.toml").string()
                                            << " --results " << tree << "$OMPI_COMM_WORLD_RANK\n";
  const std::string log = folder_.path() / "local.out";
  const int status = statusOf(IRK_MPIEXEC " -n 2 sh " + (folder_.path() / "rank.sh").string() + " > " + log + " 2>&1");
  EXPECT_NE(status, 0);
  EXPECT_TRUE(containsAll(output("local"), {"of 36 runs are missing", "all hosts share", "--results"}));
}

TEST_F(RanksOfMpi, AKilledRankLosesItsRunOnly) {
  std::ofstream(folder_.path() / "small.toml") << R"(
[[block]]
scene = "slider_crank"
families = ["radau_iia", "gauss", "lobatto_iiic"]
stages = ["3..8"]
tolerances = [1e-6, 1e-9, 1e-11]
)";
  const pid_t launcher = fork();
  if (launcher == 0) {
    execl("/bin/sh", "sh", "-c", ("exec " + command("killed", kFour)).c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  // Each rank writes a part whose name ends with the number of its process.
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::seconds(60);
  const auto waiting = [&] { return Clock::now() < deadline && waitpid(launcher, nullptr, WNOHANG) == 0; };
  while (waiting() && rowsInParts(folder("killed")) < 4) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const auto parts = partsOf(folder("killed"));
  ASSERT_FALSE(parts.empty()) << output("killed");
  const std::string stem = parts.back().stem().string();
  kill(static_cast<pid_t>(std::stol(stem.substr(stem.rfind('.') + 1))), SIGKILL);
  waitpid(launcher, nullptr, 0);

  const std::ptrdiff_t kept = rowsInParts(folder("killed"));
  ASSERT_GE(kept, 4);
  ASSERT_LT(kept, 54) << "killed too late";
  ASSERT_EQ(statusOf(command("killed") + " --wait"), 0) << output("killed");  // the other ranks may still be ending
  const std::string made = std::to_string(54 - kept) + " runs made";
  EXPECT_NE(output("killed").find(made), std::string::npos) << made << " in " << output("killed");
  ASSERT_EQ(statusOf(command("undisturbed")), 0);
  expectSame(exported("killed"), exported("undisturbed"));
}

// Four ranks on one host: one of them measures, every run once per repetition.
TEST_F(RanksOfMpi, OneRankOfAHostMeasures) {
  std::ofstream(folder_.path() / "small.toml", std::ios::app)
      << "[timing]\nmin_time_s = 1e-4\nrepetitions = 2\nonce_above_s = 600\nskip_above_s = 600\n";
  ASSERT_EQ(statusOf(command("timed", kFour)), 0) << output("timed");
  const Table timed = exported("timed");
  ASSERT_EQ(timed.rows.size(), 36u);
  std::size_t successes = 0;
  for (const auto& row : timed.rows) {
    successes += succeededAt(timed, row) ? 1u : 0u;
    EXPECT_EQ(numberAt(timed, row, "cpu_runs"), succeededAt(timed, row) ? 2 : 0);
  }
  std::size_t writers = 0, measured = 0;
  for (const auto& part : partsOf(folder("timed"))) {
    const Table rows = readTable(part);
    const auto its = static_cast<std::size_t>(std::count_if(
        rows.rows.begin(), rows.rows.end(), [&](const auto& row) { return numberAt(rows, row, "cpu_runs") > 0; }));
    writers += its > 0 ? 1u : 0u;
    measured += its;
  }
  EXPECT_EQ(writers, 1u);
  EXPECT_EQ(measured, 2 * successes);
  EXPECT_EQ(partsOf(folder("timed"), "calibrations").size(), 1u);
}

TEST_F(RanksOfMpi, AMisuseEndsAllRanks) {
  EXPECT_EQ(statusOf(command("misuse", kFour + " ") + " --shard 1/2"), 2) << output("misuse");
}

#endif

}  // namespace
}  // namespace irk
