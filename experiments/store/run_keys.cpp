#include "experiments/store/run_keys.h"

#include <algorithm>

#include "experiments/runs/block_names.h"

namespace irk::store {

RunKeys::RunKeys(const std::vector<Series>& series) : first_{0} {
  for (const auto& one : series) {
    first_.push_back(first_.back() + one.runs);
    // Series of one block follow each other.
    if (blocks_.empty() || blocks_.back() != one.block) blocks_.push_back(one.block);
    block_.push_back(static_cast<std::uint32_t>(blocks_.size() - 1));
  }
  if (blocks_.empty()) blocks_.emplace_back();
  keys_.resize(first_.back());
}

RunKeys::RunKeys(std::span<const std::uint64_t> keys) : RunKeys(std::vector<Series>{{keys.size(), {}}}) {
  set(0, keys);
  finish();
}

void RunKeys::set(std::size_t series, std::span<const std::uint64_t> keys) {
  std::copy(keys.begin(), keys.end(), keys_.begin() + static_cast<std::ptrdiff_t>(first_[series]));
}

std::vector<std::uint64_t> RunKeys::operator[](std::size_t series) const {
  return {keys_.data() + first_[series], keys_.data() + first_[series + 1]};
}

template <class Take>
void RunKeys::forAll(Take&& take) const {
  for (std::size_t series = 0; series < size(); ++series) {
    for (std::size_t run = first_[series]; run < first_[series + 1]; ++run) {
      take(keys_[run], run, blocks_[block_[series]]);
    }
  }
}

void RunKeys::finish() {
  std::vector<std::uint64_t> sorted = keys_;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i] == sorted[i - 1]) repeated_.try_emplace(sorted[i], Repeated{keys_.size(), {}});
  }
  runs_ = static_cast<std::size_t>(std::unique(sorted.begin(), sorted.end()) - sorted.begin());
  forAll([this](std::uint64_t key, std::size_t run, const std::string& block) {
    const auto at = repeated_.find(key);
    if (at == repeated_.end()) return;
    at->second.first = std::min(at->second.first, run);
    addBlocks(at->second.blocks, block);
  });
}

void RunKeys::forEach(const std::function<void(std::uint64_t, const std::string&)>& take) const {
  forAll([&](std::uint64_t key, std::size_t run, const std::string& block) {
    const auto at = repeated_.find(key);
    if (at == repeated_.end()) {
      take(key, block);
    } else if (at->second.first == run) {
      take(key, at->second.blocks);
    }
  });
}

}  // namespace irk::store
