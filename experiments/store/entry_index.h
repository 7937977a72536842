// Finds the entries of any number of rows by their keys, with bounded memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "experiments/store/entry.h"
#include "experiments/store/spill_file.h"

namespace irk::store {

/// Entries in memory. A key is found in a few steps: keys are hashes, so that the first bits of a key give the
/// approximate place of its entry. Keys that are not hashes are found as well, but more slowly.
class SortedEntries {
 public:
  SortedEntries() : SortedEntries(std::vector<Entry>()) {}
  /// Sorted by keys, each of which is there once. At most 2^32 - 1.
  explicit SortedEntries(std::vector<Entry> entries);

  std::optional<Entry> find(std::uint64_t key) const;
  const std::vector<Entry>& all() const { return entries_; }

 private:
  static constexpr std::size_t kPerGroup = 4;
  // The first bits of a key.
  std::size_t group(std::uint64_t key) const { return bits_ == 0 ? 0 : key >> (64 - bits_); }

  std::vector<Entry> entries_;
  int bits_ = 0;
  std::vector<std::uint32_t> firsts_;  // of each group the place of its first entry, and the number of all
};

/// One entry for each key: the best of those that were given. Memory holds the newest kNewest entries and up to `held`
/// sorted ones, 41 bytes each; if there are more, all but the newest are in a temporary file, of which memory holds one
/// key per page. It then needs about 5 MB and 0.1 byte per entry. Not thread-safe.
class EntryIndex {
 public:
  static constexpr std::size_t kNewest = 1 << 15;
  /// 40 MB; entries in memory are found in a tenth of the time.
  static constexpr std::size_t kHeld = 1 << 20;

  using Better = std::function<bool(const Entry& a, const Entry& b)>;
  explicit EntryIndex(Better better, std::size_t held = kHeld) : better_(std::move(better)), most_held_(held) {}

  /// Adds an entry without looking for its key. Call `sort` after the last one, before any other member.
  void add(const Entry& entry);
  void sort();

  std::optional<Entry> find(std::uint64_t key) const;
  /// Replaces the entry of this key if the new one is better.
  void put(const Entry& entry);
  std::size_t size() const { return size_; }
  /// Visits the entries by ascending keys.
  void forEach(const std::function<void(const Entry&)>& take) const;

 private:
  /// Sorted entries in the file.
  struct Run {
    std::uint64_t begin = 0;  // counts entries
    std::size_t count = 0;
    std::vector<std::uint64_t> first_keys;  // of each page
  };
  class Cursor;

  std::vector<Entry> sortedNewest() const;
  void spillNewest();
  std::optional<Entry> findIn(const Run& run, std::uint64_t key) const;

  Better better_;
  std::size_t most_held_;
  std::unordered_map<std::uint64_t, Entry> newest_;
  SortedEntries held_;  // instead of runs while there are few entries
  std::unique_ptr<SpillFile> file_;
  std::vector<Run> runs_;  // a key may be in several of them: the best entry counts, which is the newest after `put`
  std::uint64_t end_ = 0;  // entries in the file
  std::size_t size_ = 0;
};

}  // namespace irk::store
