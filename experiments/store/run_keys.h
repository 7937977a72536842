// The keys of all runs of a study, in its order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "experiments/store/spill_file.h"

namespace irk::store {

/// The keys by series. More than kHeld keys are in a temporary file: memory holds 16 bytes per series, one bit per run,
/// and the names of the blocks of runs that several series contain.
class RunKeys {
 public:
  static constexpr std::size_t kHeld = 1 << 16;

  /// The series with their numbers of runs (0 for a series of another shard, which is left out) and the names of their
  /// blocks, which may be empty. All keys are 0.
  struct Series {
    std::size_t runs = 0;
    std::string block;
  };
  explicit RunKeys(const std::vector<Series>& series);
  /// One series without a block.
  explicit RunKeys(std::span<const std::uint64_t> keys);

  /// Sets the keys of a series. Thread-safe for different series. Call `finish` after the last one.
  void set(std::size_t series, std::span<const std::uint64_t> keys);
  void finish();

  std::size_t size() const { return first_.size() - 1; }
  bool isLeftOut(std::size_t series) const { return first_[series] == first_[series + 1]; }
  std::vector<std::uint64_t> operator[](std::size_t series) const;
  /// Runs, each counted once.
  std::size_t runs() const { return first_.back() - repeated_; }
  /// Visits all keys in order, each once, with the names of all blocks that contain it.
  void forEach(const std::function<void(std::uint64_t key, const std::string& blocks)>& take) const;
  /// Whether any run has a block.
  bool hasBlocks() const { return blocks_.size() > 1 || !blocks_.front().empty(); }

 private:
  // Calls take(key, run, block) for all runs in order.
  template <class Take>
  void forAll(Take&& take) const;
  std::vector<std::uint64_t> keysBetween(std::size_t begin, std::size_t end) const;

  std::vector<std::size_t> first_;    // number of each series' first run, and of all runs
  std::vector<std::uint32_t> block_;  // of each series
  std::vector<std::string> blocks_;
  std::vector<std::uint64_t> held_;
  std::unique_ptr<SpillFile> file_;
  std::vector<bool> is_repeat_;  // of an earlier run; empty if there are none
  std::size_t repeated_ = 0;
  std::unordered_map<std::uint64_t, std::string> blocks_of_repeated_;
};

}  // namespace irk::store
