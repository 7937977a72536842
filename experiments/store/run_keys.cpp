#include "experiments/store/run_keys.h"

#include <algorithm>

#include "experiments/runs/block_names.h"
#include "experiments/store/entry_index.h"

namespace irk::store {

RunKeys::RunKeys(const std::vector<Series>& series) : first_{0} {
  for (const auto& one : series) {
    first_.push_back(first_.back() + one.runs);
    // Series of one block follow each other.
    if (blocks_.empty() || blocks_.back() != one.block) blocks_.push_back(one.block);
    block_.push_back(static_cast<std::uint32_t>(blocks_.size() - 1));
  }
  if (blocks_.empty()) blocks_.emplace_back();
  if (first_.back() <= kHeld) {
    held_.resize(first_.back());
  } else {
    file_ = std::make_unique<SpillFile>();
  }
}

RunKeys::RunKeys(std::span<const std::uint64_t> keys) : RunKeys(std::vector<Series>{{keys.size(), {}}}) {
  set(0, keys);
  finish();
}

void RunKeys::set(std::size_t series, std::span<const std::uint64_t> keys) {
  if (file_) {
    file_->write(keys.data(), keys.size_bytes(), first_[series] * sizeof(std::uint64_t));
  } else {
    std::copy(keys.begin(), keys.end(), held_.begin() + static_cast<std::ptrdiff_t>(first_[series]));
  }
}

std::vector<std::uint64_t> RunKeys::keysBetween(std::size_t begin, std::size_t end) const {
  std::vector<std::uint64_t> keys(end - begin);
  if (file_) {
    file_->read(keys.data(), keys.size() * sizeof(std::uint64_t), begin * sizeof(std::uint64_t));
  } else {
    std::copy_n(held_.begin() + static_cast<std::ptrdiff_t>(begin), keys.size(), keys.begin());
  }
  return keys;
}

std::vector<std::uint64_t> RunKeys::operator[](std::size_t series) const {
  return keysBetween(first_[series], first_[series + 1]);
}

template <class Take>
void RunKeys::forAll(Take&& take) const {
  std::size_t series = 0;
  for (std::size_t begin = 0; begin < first_.back(); begin += kHeld) {
    std::size_t run = begin;
    for (const auto key : keysBetween(begin, std::min(begin + kHeld, first_.back()))) {
      while (first_[series + 1] <= run) ++series;
      take(key, run++, blocks_[block_[series]]);
    }
  }
}

void RunKeys::finish() {
  EntryIndex first([](const Entry& a, const Entry& b) { return a.offset < b.offset; });
  forAll([&first](std::uint64_t key, std::size_t run, const std::string&) { first.add({.key = key, .offset = run}); });
  first.sort();
  repeated_ = first_.back() - first.size();
  if (repeated_ == 0) return;
  is_repeat_.resize(first_.back());
  forAll([&](std::uint64_t key, std::size_t run, const std::string&) {
    if (first.find(key)->offset == run) return;
    is_repeat_[run] = true;
    blocks_of_repeated_.try_emplace(key);
  });
  forAll([this](std::uint64_t key, std::size_t, const std::string& block) {
    const auto at = blocks_of_repeated_.find(key);
    if (at != blocks_of_repeated_.end()) addBlocks(at->second, block);
  });
}

void RunKeys::forEach(const std::function<void(std::uint64_t, const std::string&)>& take) const {
  forAll([&](std::uint64_t key, std::size_t run, const std::string& block) {
    if (repeated_ == 0) {
      take(key, block);
    } else if (!is_repeat_[run]) {
      const auto at = blocks_of_repeated_.find(key);
      take(key, at == blocks_of_repeated_.end() ? block : at->second);
    }
  });
}

}  // namespace irk::store
