// Which processors measure at once, on how many, and calls in processes on them.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/base/clock.h"
#include "experiments/runner/cores/at_once.h"
#include "experiments/runner/cores/children.h"
#include "experiments/runner/cores/processors.h"
#include "irk/misuse.h"
#include "tests/experiments/shared_count.h"
#include "tests/experiments/support.h"

namespace irk::cores {
namespace {

// Four cores of two processors each, 0 and 4, 1 and 5, 2 and 6, 3 and 7; two cores share a cache.
class FourCores : public testing::Test {
 protected:
  void SetUp() override {
    for (int processor = 0; processor < 8; ++processor) {
      const int core = processor % 4;
      write(processor, "topology", "thread_siblings_list", std::to_string(core) + "," + std::to_string(core + 4));
      write(processor, "cache/index3", "shared_cpu_list", core < 2 ? "0-1,4-5" : "2-3,6-7");
    }
  }
  void write(int processor, const std::string& folder, const std::string& file, const std::string& line) const {
    const auto its = folder_.path() / ("cpu" + std::to_string(processor)) / folder;
    std::filesystem::create_directories(its);
    std::ofstream(its / file) << line << '\n';
  }
  std::vector<int> of(const std::vector<int>& allowed) const { return physicalCores(allowed, folder_.path()); }
  TemporaryFolder folder_;
};

TEST_F(FourCores, OneProcessorOfEachAndCachesInTurn) {
  EXPECT_EQ(of({0, 1, 2, 3, 4, 5, 6, 7}), (std::vector<int>{0, 2, 1, 3}));
  EXPECT_EQ(of({1, 3, 4, 5, 7}), (std::vector<int>{1, 3, 4}));
  EXPECT_EQ(of({6}), std::vector<int>{6});
}

TEST(PhysicalCores, WhatTheSystemDoesNotTellIsNotShared) {
  EXPECT_EQ(physicalCores({0, 3, 5}, "/no/such/folder"), (std::vector<int>{0, 3, 5}));
}

// Times of two computations by the number of cores; a number that is not in the table may not be asked for.
MeasureCores madeUp(const std::map<std::size_t, KernelSeconds>& times) {
  return [times](std::size_t cores) { return times.at(cores); };
}

TEST(TryCores, TakesTheLargestNumberThatDisturbsNeitherComputation) {
  const auto taken = [](std::size_t most, const std::map<std::size_t, KernelSeconds>& times) {
    return takenOf(tryCores(most, madeUp(times)));
  };
  EXPECT_EQ(taken(1, {}), 1u);
  EXPECT_EQ(taken(2, {{1, {1, 2}}, {2, {1, 2}}}), 2u);
  EXPECT_EQ(taken(6, {{1, {1, 2}}, {2, {1.01, 2.01}}, {4, {1.02, 2.02}}, {6, {1.02, 2.04}}}), 6u);
  EXPECT_EQ(taken(16, {{1, {1, 2}}, {2, {1, 2}}, {4, {1, 2}}, {8, {1, 2.1}}}), 4u) << "vectors 1.05 times as long";
  EXPECT_EQ(taken(16, {{1, {1, 2}}, {2, {1.05, 2}}}), 1u) << "elimination 1.05 times as long";
  EXPECT_EQ(taken(3, {{1, {1, 2}}, {2, {1, 2}}, {3, {1.05, 2}}}), 2u);
  EXPECT_EQ(taken(2, {{1, {1, 2}}, {2, {0.9, 1.8}}}), 2u) << "other load has ended";
}

TEST(TryCores, OtherLoadBesideTheFirstCoreHidesNothing) {
  int alone = 0;
  const auto trials = tryCores(2, [&](std::size_t cores) {
    if (cores == 1) return ++alone == 1 ? KernelSeconds{1.5, 3} : KernelSeconds{1, 2};
    return KernelSeconds{1.2, 2};
  });
  EXPECT_EQ(takenOf(trials), 1u);
  EXPECT_DOUBLE_EQ(trials.back().elimination, 1.2);
}

TEST(TryCores, KeepsWhatWasMeasured) {
  const auto trials = tryCores(8, madeUp({{1, {1, 2}}, {2, {1, 2.02}}, {4, {1.5, 3}}}));
  ASSERT_EQ(trials.size(), 3u);
  EXPECT_EQ(trials[1].cores, 2u);
  EXPECT_EQ(trials[1].elimination, 1);
  EXPECT_DOUBLE_EQ(trials[1].vectors, 1.01);
  EXPECT_TRUE(trials[1].taken);
  EXPECT_FALSE(trials[0].taken || trials[2].taken);
  EXPECT_TRUE(containsAll(textOf(trials, 8), {"2 of 8 cores at once", "on 2 cores", "1.00 and 1.01 times", "on 4 cores",
                                              "1.50 and 1.50 times", "allowed are 1.03"}))
      << textOf(trials, 8);
}

TEST(TryCores, ANumberThatFailsIsNotTaken) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const auto trials = tryCores(4, madeUp({{1, {1, 2}}, {2, {kNever, kNever}}}));
  EXPECT_EQ(takenOf(trials), 1u);
  EXPECT_TRUE(containsAll(textOf(trials, 4), {"1 of 4 cores at once", "on 2 cores two fixed computations cannot"}));
}

TEST(MeasureOn, GivesSecondsOfBothComputations) {
  const auto seconds = measureOn(physicalCores(), 1);
  EXPECT_GT(seconds.elimination, 1e-5);
  EXPECT_GT(seconds.vectors, 1e-4) << "48 MiB take longer to pass through";
  EXPECT_LT(seconds.elimination + seconds.vectors, 1);
}

TEST(RequireCores, NamesOptionValueAndRange) {
  const auto available = std::to_string(physicalCores().size());
  EXPECT_NO_THROW(requireCores(0));
  EXPECT_NO_THROW(requireCores(1));
  for (const int wrong : {-1, 1024}) {
    const auto given = "timing-cores = " + std::to_string(wrong);
    EXPECT_TRUE(containsAll(misuseOf([&] { requireCores(wrong); }), {given, "from 1 to " + available, "or 0"}));
  }
}

constexpr double kLong = 20;  // s; a call that waits so long has waited in vain

// The first processor twice: what is tested does not need two.
std::vector<int> twoPlaces() { return {physicalCores().front(), physicalCores().front()}; }

// Each of two calls waits for the other.
TEST(Children, WorkAtTheSameTime) {
  const SharedCount begun;
  const auto call = [&] {
    begun.add();
    for (const double end = wallSeconds() + kLong; begun.value() < 2 && wallSeconds() < end;) usleep(1000);
    return std::vector<double>{static_cast<double>(begun.value()), static_cast<double>(getpid())};
  };
  std::vector<double> counts, processes;
  Children children(twoPlaces());
  for (int i = 0; i < 2; ++i) {
    children.begin(call, [&](const Answer& answer) {
      ASSERT_EQ(answer.failure, "");
      counts.push_back(answer.numbers[0]);
      processes.push_back(answer.numbers[1]);
    });
  }
  children.finish();
  EXPECT_EQ(counts, (std::vector<double>{2, 2}));
  ASSERT_EQ(processes.size(), 2u);
  EXPECT_NE(processes[0], processes[1]);
}

TEST(Children, OneProcessorMakesOneCallAtATimeOnItself) {
  const int processor = physicalCores().back();
  std::vector<double> order;
  Children children({processor});
  for (int i = 0; i < 3; ++i) {
    children.begin(
        [i] {
          return std::vector<double>{static_cast<double>(i), static_cast<double>(physicalCores().front())};
        },
        [&](const Answer& answer) {
          order.push_back(answer.numbers[0]);
          EXPECT_EQ(answer.numbers[1], processor);
        });
    EXPECT_EQ(order.size(), static_cast<std::size_t>(i)) << "the calls before have ended";
  }
  children.finish();
  EXPECT_EQ(order, (std::vector<double>{0, 1, 2}));
}

TEST(Children, TellHowACallEnded) {
  const auto failureOf = [](const Call& call, int processor) {
    std::string failure = "none";
    Children children({processor});
    children.begin(call, [&](const Answer& answer) { failure = answer.failure; });
    children.finish();
    return failure;
  };
  const int here = physicalCores().front();
  const auto one = [] { return std::vector<double>{1}; };
  EXPECT_EQ(failureOf(one, here), "");
  EXPECT_EQ(failureOf([]() -> std::vector<double> { throw Misuse("no such scene"); }, here), "no such scene");
  EXPECT_EQ(failureOf([]() -> std::vector<double> { throw std::runtime_error(""); }, here),
            "an exception without a text");
  // A handler of this process, as for crashes of own scenes, is not the call's.
  const auto before = std::signal(SIGSEGV, [](int) { _exit(1); });
  const auto crashed = failureOf([]() -> std::vector<double> { return raise(SIGSEGV), std::vector<double>(); }, here);
  std::signal(SIGSEGV, before);
  EXPECT_TRUE(containsAll(crashed, {"signal 11"})) << crashed;
  const auto killed = failureOf([]() -> std::vector<double> { return raise(SIGKILL), std::vector<double>(); }, here);
  EXPECT_TRUE(containsAll(killed, {"signal 9", "Killed"})) << killed;
  const auto left = failureOf([]() -> std::vector<double> { _exit(3); }, here);
  EXPECT_TRUE(containsAll(left, {"without a result", "exit status 3"})) << left;
  EXPECT_TRUE(containsAll(failureOf(one, 1023), {"processor 1023 cannot be used"})) << failureOf(one, 1023);
}

// Ctrl-C reaches all processes of a terminal; what has begun is measured all the same.
TEST(Children, AnInterruptDoesNotEndACall) {
  std::vector<double> numbers;
  Children children({physicalCores().front()});
  children.begin(
      [] {
        raise(SIGINT);
        raise(SIGTERM);
        return std::vector<double>{7};
      },
      [&](const Answer& answer) { numbers = answer.numbers; });
  children.finish();
  EXPECT_EQ(numbers, std::vector<double>{7});
}

// Returns whether all processes that have inherited the pipe's end for writing end before long.
bool closesSoon(int pipe) {
  pollfd end{.fd = pipe, .events = POLLIN, .revents = 0};
  return poll(&end, 1, static_cast<int>(1000 * kLong)) == 1;
}

TEST(Children, EndWithTheirObjectAndWithTheirParent) {
  const SharedCount begun;
  const auto lastLong = [&begun]() -> std::vector<double> {
    begun.add();
    sleep(10 * static_cast<unsigned>(kLong));
    return {};
  };
  const auto begin = [&](Children& children, int all) {
    for (int i = 0; i < 2; ++i) children.begin(lastLong, [](const Answer&) {});
    for (const double end = wallSeconds() + kLong; begun.value() < all && wallSeconds() < end;) usleep(1000);
  };
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  {
    Children children(twoPlaces());
    begin(children, 2);
  }
  const pid_t parent = fork();
  if (parent == 0) {
    Children children(twoPlaces());
    begin(children, 4);
    raise(SIGKILL);
  }
  waitpid(parent, nullptr, 0);
  EXPECT_EQ(begun.value(), 4);
  close(ends[1]);
  EXPECT_TRUE(closesSoon(ends[0])) << "a call lives on";
  close(ends[0]);
}

}  // namespace
}  // namespace irk::cores
