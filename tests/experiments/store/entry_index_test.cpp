// Indices and keys that do not fit into the memory that they may use give the same answers as those that do.
#include "experiments/store/entry_index.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "experiments/base/numbers.h"
#include "experiments/store/run_keys.h"
#include "tests/experiments/stored_runs.h"

namespace irk::store {
namespace {

constexpr std::size_t kNewest = EntryIndex::kNewest;
// Sorted entries in a file or in memory.
constexpr std::size_t kInFileOrMemory[] = {kNewest, EntryIndex::kHeld};

bool isLater(const Entry& a, const Entry& b) { return a.date > b.date; }

std::uint64_t keyOf(std::size_t i) { return fnv1a(std::to_string(i)); }

/// An index and what it must contain.
struct Both {
  explicit Both(std::size_t held) : index(isLater, held) {}

  EntryIndex index;
  std::map<std::uint64_t, std::uint32_t> dates;

  void note(std::uint64_t key, std::uint32_t date) { dates[key] = std::max(dates[key], date); }
  void check() const {
    ASSERT_EQ(index.size(), dates.size());
    for (const auto& [key, date] : dates) {
      const auto found = index.find(key);
      ASSERT_TRUE(found);
      ASSERT_EQ(found->date, date);
    }
    EXPECT_FALSE(index.find(12345));
    auto next = dates.begin();
    index.forEach([&](const Entry& entry) {
      ASSERT_EQ(entry.key, next->first);
      ASSERT_EQ(entry.date, next->second);
      ++next;
    });
    EXPECT_EQ(next, dates.end());
  }
};

// Hashes and keys that share their first bits.
TEST(SortedEntries, FindsEveryKey) {
  constexpr std::uint64_t kMost = ~std::uint64_t(0);
  const std::vector<std::function<std::uint64_t(std::size_t)>> kinds = {
      [](std::size_t i) { return keyOf(i); }, [](std::size_t i) { return 2 * i; },
      [](std::size_t i) { return kMost - 2 * i; }, [](std::size_t i) { return i < 50 ? 2 * i : kMost - 2 * i; }};
  for (const auto& kind : kinds) {
    for (const std::size_t count : {0u, 1u, 4u, 5u, 8u, 9u, 100u, 1000u}) {
      std::set<std::uint64_t> keys;
      for (std::size_t i = 0; i < count; ++i) keys.insert(kind(i));
      std::vector<Entry> entries;
      for (const auto key : keys) entries.push_back({.key = key});
      const SortedEntries sorted(std::move(entries));
      ASSERT_EQ(sorted.all().size(), count);
      for (const auto key : keys) {
        ASSERT_TRUE(sorted.find(key)) << key << " of " << count;
        ASSERT_EQ(sorted.find(key)->key, key);
        for (const auto other : {key - 1, key + 1}) {
          ASSERT_EQ(sorted.find(other).has_value(), keys.contains(other)) << other << " of " << count;
        }
      }
      EXPECT_EQ(sorted.find(0).has_value(), keys.contains(0));
      EXPECT_EQ(sorted.find(kMost).has_value(), keys.contains(kMost));
    }
  }
}

TEST(EntryIndex, FindsTheBestOfAnyNumber) {
  for (const std::size_t keys : {std::size_t(0), std::size_t(1), kNewest - 1, kNewest, kNewest + 1, 3 * kNewest + 17}) {
    for (const std::size_t held : kInFileOrMemory) {
      SCOPED_TRACE(std::to_string(keys) + ", held " + std::to_string(held));
      Both both(held);
      std::mt19937 random(1);
      for (std::size_t i = 0; i < keys + keys / 2; ++i) {  // a third of the keys twice or more
        const std::uint64_t key = keyOf(i < keys ? i : random() % keys);
        const auto date = static_cast<std::uint32_t>(random() % 100 + 1);
        both.index.add({.key = key, .date = date});
        both.note(key, date);
      }
      both.index.sort();
      both.check();
    }
  }
}

// More runs of entries in the file than are kept apart.
TEST(EntryIndex, TakesNewEntriesBehindSortedOnes) {
  for (const std::size_t held : kInFileOrMemory) {
    SCOPED_TRACE(held);
    Both both(held);
    std::mt19937 random(1);
    for (std::size_t i = 0; i < 2 * kNewest; ++i) {
      both.index.add({.key = keyOf(i), .date = 50});
      both.note(keyOf(i), 50);
    }
    both.index.sort();
    for (std::size_t i = 0; i < 19 * kNewest; ++i) {
      const std::uint64_t key = keyOf(i % 3 == 0 ? random() % (2 * kNewest) : i);
      const auto date = static_cast<std::uint32_t>(random() % 100 + 1);
      both.index.put({.key = key, .date = date});
      both.note(key, date);
    }
    both.check();
  }
}

TEST(RunKeys, GiveEachRunOnceWithAllItsBlocks) {
  for (const std::size_t runs : {std::size_t(10), RunKeys::kHeld + 18}) {
    SCOPED_TRACE(runs);
    // The third series repeats every second run of the first; the second one is left out.
    RunKeys keys({{runs, "a"}, {0, "a"}, {runs, "b"}});
    std::vector<std::uint64_t> first, third;
    for (std::size_t i = 0; i < runs; ++i) {
      first.push_back(keyOf(i));
      third.push_back(keyOf(i % 2 == 0 ? i : runs + i));
    }
    keys.set(0, first);
    keys.set(2, third);
    keys.finish();
    EXPECT_TRUE(keys.isLeftOut(1));
    EXPECT_FALSE(keys.isLeftOut(2));
    EXPECT_EQ(keys[0], first);
    EXPECT_EQ(keys[2], third);
    EXPECT_EQ(keys.runs(), runs + runs / 2);
    std::vector<std::uint64_t> order = first;
    for (std::size_t i = 1; i < runs; i += 2) order.push_back(third[i]);
    std::size_t next = 0;
    keys.forEach([&](std::uint64_t key, const std::string& blocks) {
      ASSERT_EQ(key, order[next]);
      ASSERT_EQ(blocks, next >= runs ? "b" : next % 2 == 0 ? "a b" : "a") << next;
      ++next;
    });
    EXPECT_EQ(next, order.size());
  }
}

// More rows than the newest ones: each is found again and exported once.
TEST(LargeStore, FindsAndExportsEveryRow) {
  const TemporaryFolder folder;
  std::ostringstream quiet;
  RunRecord record;
  record.spec.scene = "kepler";
  record.outcome = "success";
  std::vector<std::uint64_t> keys;
  {
    Store writer(folder.path(), "large", Use::kWrite, {}, quiet);
    record.spec = resolved(record.spec);
    for (std::size_t i = 0; i < kNewest + 100; ++i) {
      record.spec.options.tolerances.rtol = 1e-3 / static_cast<double>(i + 1);
      const std::string key = specKey(record.spec);
      keys.push_back(keyNumber(key));
      writer.addRun(runRow(key, "large", record));
    }
  }
  Store store(folder.path(), "large", Use::kWrite, {}, quiet);
  EXPECT_EQ(store.runs().size(), keys.size());
  for (const auto key : keys) ASSERT_TRUE(store.finished(key));
  store.exportTables(RunKeys(keys));
  const Table exported = readTable(folder.path() / "runs.csv");
  ASSERT_EQ(exported.rows.size(), keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) ASSERT_EQ(exported.rows[i].front(), hexText(keys[i]));
}

}  // namespace
}  // namespace irk::store
