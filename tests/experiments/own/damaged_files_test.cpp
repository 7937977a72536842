// What the program says about users' files that do not do what they should.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <thread>

#include "experiments/own/compiler.h"
#include "experiments/own/stuck.h"
#include "tests/experiments/own/own_files.h"

namespace irk {
namespace {

// The last line on standard error; standard output has the record of the run.
TEST_F(OwnFiles, FailuresOfASolverAreALine) {
  const std::string solve =
      "solve kepler --t-end 1 --tol 1e-4 --error-bar none --method " IRK_SOLVERS "/damaged.so 2>&1 >/dev/null | cat";
  const auto said = [&](const std::string& damage) { return irk(solve, "IRK_DAMAGE='" + damage + "'").text; };
  EXPECT_EQ(said(""), "");
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases{
      {"throws", {"damaged.so throws: no licence"}},
      {"throws a number", {"damaged.so throws: an exception without text"}},
      {"exits", {"damaged.so called exit()"}},
      {"aborts", {"crashed", "damaged.so"}},
      {"returns early", {"kepler with damaged failed: step_too_small", "returned before the end", "t = 0.01"}},
      {"fails", {"kepler with damaged failed: singular", "irk_peer_solve returned 5"}},
      {"unknown outcome", {"kepler with damaged failed", "irk_peer_solve returned 99, 0 to 5 is allowed"}},
      {"goes back", {"kepler with damaged failed: not_finite", "step to -0.01", "up to 1"}},
      {"goes on", {"kepler with damaged failed: not_finite", "step to 1.01", "up to 1"}},
      {"explains nothing", {"kepler with damaged failed: newton_failed", "irk_peer_solve returned 1"}},
      {"is not finite", {"kepler with damaged failed: not_finite", "a state that is not finite"}}};
  for (const auto& [damage, parts] : cases) {
    const std::string text = said(damage);
    EXPECT_TRUE(containsAll(text, parts));
    EXPECT_TRUE(text.starts_with("irk: ")) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  }
}

TEST_F(OwnFiles, FailuresOfASolverHaveTheStatusOfFailures) {
  for (const char* damage : {"throws", "exits", "aborts", "fails"}) {
    const Ran ran = irk("solve kepler --t-end 1 --tol 1e-4 --method " IRK_SOLVERS "/damaged.so",
                        std::string("IRK_DAMAGE=") + damage);
    EXPECT_EQ(ran.status, 1) << damage << ran.text;
  }
}

TEST_F(OwnFiles, ADamagedSolverInAStudyLeavesTheOtherRuns) {
  write("mine.toml", std::string("[[block]]\nscene = 'kepler'\nt_end = 1\ntolerances = [1e-3, 1e-4]\n") +
                         "methods = ['gauss_2', '" IRK_SOLVERS "/damaged.so']\n");
  const Ran ran = irk("run mine.toml", "IRK_DAMAGE=fails");
  EXPECT_TRUE(containsAll(ran.text, {"4 runs", "2 success", "2 singular"})) << ran.text;
}

TEST_F(OwnFiles, ASymbolThatIsMissingIsNamed) {
  write("mine.cpp", "double table(double);\ndouble g_x = table(1);\n");
  const Ran ran = irk("solve mine.cpp --method gauss_2 --tol 1e-3");
  EXPECT_EQ(ran.status, 2);
  EXPECT_TRUE(containsAll(ran.text, {"irk: mine.cpp: compiled, but", "undefined symbol: table(double)"})) << ran.text;
}

TEST(CompilerMessages, TheRefusalNamesLineAndError) {
  const auto refusal = [](const std::string& messages) { return own::refusalOf("mine.cpp", "/a/mine.cpp", messages); };
  EXPECT_EQ(refusal("/a/mine.cpp: In function 'f':\n/a/mine.cpp:3:1: error: expected ';'\n/a/mine.cpp:5:1: error: b\n"),
            "mine.cpp:3: it does not compile: expected ';'");
  EXPECT_EQ(refusal("/a/mine.cpp:2:10: fatal error: x.h: No such file or directory\n"),
            "mine.cpp:2: it does not compile: x.h: No such file or directory");
  // In a header, reached from line 7.
  EXPECT_EQ(refusal("/a/mine.cpp:7:4:   required from here\n/usr/x.h:1:2: error: no member 'residual'\n"),
            "mine.cpp:7: it does not compile: no member 'residual'");
  EXPECT_EQ(refusal("/usr/x.h:1:2: error: no member\n    7 | text  error: none\n"),
            "mine.cpp: it does not compile: no member");
  EXPECT_EQ(refusal("killed\n"), "mine.cpp: it does not compile");
}

// The cause is told, though a program that was replaced is older than all headers, too.
TEST(CompilerMessages, AProgramThatWasReplacedIsToBeStartedAgain) {
  const TemporaryFolder folder;
  const auto program = folder.path() / "irk";
  std::filesystem::copy("/bin/sleep", program);
  const auto ten_years = std::chrono::hours(24 * 3652);
  std::filesystem::last_write_time(program, std::filesystem::file_time_type::clock::now() - ten_years);
  const pid_t child = fork();
  if (child == 0) {
    execl(program.c_str(), "irk", "100", nullptr);
    _exit(127);
  }
  const std::filesystem::path running = "/proc/" + std::to_string(child) + "/exe";
  while (std::filesystem::read_symlink(running) != program) std::this_thread::yield();
  const std::string header = IRK_SOURCE_DIR "/core/include/irk/problem.h";
  const auto refused = [&] { return misuseOf([&] { own::requireHeadersOfProgram({header}, running); }); };
  EXPECT_EQ(refused(), header +
                           " is newer than this program, which was built with a former version of it: build the "
                           "program again");
  std::filesystem::remove(program);
  EXPECT_EQ(refused(), program.string() + " was replaced since this program was started from it, and " + header +
                           " is newer: start it again");
  EXPECT_NO_THROW(own::requireHeadersOfProgram({"/usr/include/stdio.h"}, running));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

void keepBusy(double seconds) {
  const auto end = std::clock() + static_cast<std::clock_t>(seconds * CLOCKS_PER_SEC);
  while (std::clock() < end) {
  }
}

TEST(StuckDeathTest, CodeThatDoesNotReturnIsToldOnce) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  const auto stuck = [] {
    own::askWhenStuck("mine.cpp", 1);
    keepBusy(3.5);
    std::_Exit(3);
  };
  EXPECT_EXIT(stuck(), testing::ExitedWithCode(3),
              "^irk: no step has ended for 1 s of CPU time: does code of mine.cpp not end[^\n]*\n$");
  const auto going = [] {
    own::askWhenStuck("mine.cpp", 2);
    for (int i = 0; i < 30; ++i) {
      keepBusy(0.1);
      own::stillGoing(0);
    }
    std::_Exit(3);
  };
  EXPECT_EXIT(going(), testing::ExitedWithCode(3), "^$");
}

// With a time limit it does not wait for the user.
TEST(StuckDeathTest, CodeThatDoesNotReturnEndsAfterTheTimeLimit) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  const auto stuck = [](double limit) {
    own::askWhenStuck("mine.cpp", 1);
    own::stillGoing(limit);
    keepBusy(2.5 + std::thread::hardware_concurrency());
    std::_Exit(3);
  };
  const std::string asked = "^irk: no step has ended for 1 s of CPU time[^\n]*mine.cpp[^\n]*\n";
  EXPECT_EXIT(stuck(1), testing::ExitedWithCode(1), asked + "irk: no step[^\n]*time limit[^\n]*mine.cpp[^\n]*\n$");
  EXPECT_EXIT(stuck(1000), testing::ExitedWithCode(3), asked + "$");
}

}  // namespace
}  // namespace irk
