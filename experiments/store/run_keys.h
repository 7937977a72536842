// The keys of all runs of a study, in its order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace irk::store {

/// The keys by series: 8 bytes per run, 12 per series, and the names of the blocks of runs that several series contain.
class RunKeys {
 public:
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
  std::size_t runs() const { return runs_; }
  /// Visits all keys in order, each once, with the names of all blocks that contain it.
  void forEach(const std::function<void(std::uint64_t key, const std::string& blocks)>& take) const;
  /// Whether any run has a block.
  bool hasBlocks() const { return blocks_.size() > 1 || !blocks_.front().empty(); }

 private:
  // Calls take(key, run, block) for all runs in order.
  template <class Take>
  void forAll(Take&& take) const;

  std::vector<std::size_t> first_;    // number of each series' first run, and of all runs
  std::vector<std::uint32_t> block_;  // of each series
  std::vector<std::string> blocks_;
  std::vector<std::uint64_t> keys_;
  std::size_t runs_ = 0;
  struct Repeated {
    std::size_t first;  // the number of the run where it stands first
    std::string blocks;
  };
  std::unordered_map<std::uint64_t, Repeated> repeated_;  // what several series contain, by its key
};

}  // namespace irk::store
