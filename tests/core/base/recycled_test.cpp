#include "core/base/recycled.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <set>
#include <thread>
#include <vector>

namespace irk::test {
namespace {

template <std::size_t kBytes>
struct Large : Recycled {
  std::array<char, kBytes> bytes{};
};

#ifdef __SANITIZE_ADDRESS__
constexpr bool kKeeps = false;
#else
constexpr bool kKeeps = true;
#endif

std::uintptr_t address(const void* object) { return reinterpret_cast<std::uintptr_t>(object); }

TEST(Recycled, TheNextObjectOfItsSizeTakesTheMemoryOfADestroyedOne) {
  auto object = std::make_unique<Large<2000>>();
  const std::uintptr_t first = address(object.get());
  object.reset();
  const auto other = std::make_unique<Large<3000>>();
  EXPECT_NE(address(other.get()), first);
  object = std::make_unique<Large<2000>>();
  EXPECT_EQ(address(object.get()) == first, kKeeps);
}

TEST(Recycled, ObjectsThatLiveShareNoMemory) {
  std::vector<std::unique_ptr<Large<1000>>> all;
  for (int round = 0; round < 2; ++round) {
    all.clear();
    std::set<std::uintptr_t> begins;
    for (int i = 0; i < 20; ++i) {  // more than are kept
      all.push_back(std::make_unique<Large<1000>>());
      begins.insert(address(all.back().get()));
      EXPECT_EQ(*begins.rbegin() % 64, 0);
    }
    for (auto i = begins.begin(), next = std::next(i); next != begins.end(); ++i, ++next) EXPECT_GE(*next - *i, 1000);
  }
}

TEST(Recycled, AtMostEightBlocksOfASizeAreKept) {
  std::vector<std::unique_ptr<Large<5000>>> all;
  for (int i = 0; i < 20; ++i) all.push_back(std::make_unique<Large<5000>>());
  std::vector<std::uintptr_t> begins;
  for (auto& one : all) begins.push_back(address(one.get()));
  all.clear();
  // The last one that was kept comes first.
  const auto next = std::make_unique<Large<5000>>();
  EXPECT_EQ(address(next.get()) == begins[7], kKeeps);
}

// As an object of static storage: it is destroyed after the thread's list of free blocks, and its memory is not kept.
TEST(Recycled, AnObjectMayOutliveTheListOfItsThread) {
  int destroyed = 0;
  struct Counted : Large<2000> {
    explicit Counted(int& n) : count(n) {}
    ~Counted() { ++count; }
    int& count;
  };
  std::thread([&] {
    thread_local std::unique_ptr<Counted> last;
    last.reset();  // constructed before the list
    std::make_unique<Counted>(destroyed).reset();
    last = std::make_unique<Counted>(destroyed);
  }).join();
  EXPECT_EQ(destroyed, 2);
}

}  // namespace
}  // namespace irk::test
