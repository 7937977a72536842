// A list that may be larger than the memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <type_traits>
#include <vector>

#include "experiments/store/spill_file.h"

namespace irk::store {

/// Memory holds up to kHeld items; the others are in a temporary file, which is made when it is needed. Not
/// thread-safe. Throws Failure.
template <class Item>
class SpillList {
  static_assert(std::is_trivially_copyable_v<Item>);

 public:
  static constexpr std::size_t kHeld = 1 << 12;

  void add(const Item& item) {
    newest_.push_back(item);
    if (newest_.size() < kHeld) return;
    if (!file_) file_ = std::make_unique<SpillFile>();
    file_->write(newest_.data(), kHeld * sizeof(Item), spilled_ * sizeof(Item));
    spilled_ += kHeld;
    newest_.clear();
  }
  std::size_t size() const { return spilled_ + newest_.size(); }
  /// In the order in which they were added.
  void forEach(const std::function<void(const Item&)>& take) const {
    std::vector<Item> page(std::min(spilled_, kHeld));
    for (std::size_t i = 0; i < spilled_; i += kHeld) {
      file_->read(page.data(), kHeld * sizeof(Item), i * sizeof(Item));
      std::for_each(page.begin(), page.end(), take);
    }
    std::for_each(newest_.begin(), newest_.end(), take);
  }
  /// All items in memory.
  std::vector<Item> all() const {
    std::vector<Item> items;
    items.reserve(size());
    forEach([&items](const Item& item) { items.push_back(item); });
    return items;
  }

 private:
  std::vector<Item> newest_;
  std::size_t spilled_ = 0;
  std::unique_ptr<SpillFile> file_;
};

}  // namespace irk::store
