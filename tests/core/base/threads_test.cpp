#include "core/base/threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace irk::test {
namespace {

TEST(OnThreads, CallsEachIndexOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    for (const std::size_t n : {0U, 1U, 2U, 7U, 100U}) {
      std::vector<std::atomic<int>> calls(n);
      onThreads(threads, n, [&](std::size_t i) { ++calls[i]; });
      for (const auto& count : calls) EXPECT_EQ(count, 1) << threads << " threads, " << n;
    }
  }
}

// Each of two indices waits for the other: one thread alone would wait for ever.
TEST(OnThreads, WorksAtTheSameTime) {
  std::atomic<int> begun = 0;
  onThreads(2, 2, [&](std::size_t) {
    ++begun;
    while (begun < 2) std::this_thread::yield();
  });
  EXPECT_EQ(begun, 2);
}

// Thousands of short loops, of changing numbers of threads, begun by three threads at a time.
TEST(OnThreads, LoopsFollowEachOtherOnSeveralTeams) {
  const auto loops = [] {
    for (int loop = 0; loop < 3000; ++loop) {
      const std::size_t n = 2 + static_cast<std::size_t>(loop % 7);
      std::vector<std::size_t> squares(n);
      onThreads(2 + loop / 1000, n, [&](std::size_t i) { squares[i] = i * i; });
      for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(squares[i], i * i) << loop;
    }
  };
  std::vector<std::thread> others;
  for (int i = 0; i < 2; ++i) others.emplace_back(loops);
  loops();
  for (std::thread& other : others) other.join();
}

TEST(OnThreads, ALoopInsideALoopTakesOneThread) {
  onThreads(2, 4, [](std::size_t) {
    const std::thread::id outer = std::this_thread::get_id();
    onThreads(2, 4, [&](std::size_t) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // time for others to come
      EXPECT_EQ(std::this_thread::get_id(), outer);
    });
  });
}

TEST(OnThreads, ThrowsTheExceptionOfTheFirstIndex) {
  for (const int threads : {1, 3}) {
    try {
      onThreads(threads, 50, [](std::size_t i) {
        if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
      });
      FAIL() << "nothing thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "7");
    }
  }
}

TEST(InParts, CoversTheRowsByPartsThatBeginAtMultiplesOfEight) {
  for (const int threads : {1, 2, 3, 8}) {
    for (const Index n : {0, 1, 2047, 2048, 2055, 5000, 20001}) {
      std::vector<std::atomic<int>> calls(static_cast<std::size_t>(n));
      std::atomic<int> parts = 0;
      inParts(threads, n, [&](Index first, Index last) {
        ++parts;
        EXPECT_EQ(first % 8, 0);
        for (Index i = first; i < last; ++i) ++calls[static_cast<std::size_t>(i)];
      });
      for (const auto& count : calls) ASSERT_EQ(count, 1) << threads << " threads, " << n << " rows";
      EXPECT_EQ(parts, n < 2048 ? 1 : std::min<Index>(threads, n / 1024)) << threads << " threads, " << n << " rows";
    }
  }
}

}  // namespace
}  // namespace irk::test
