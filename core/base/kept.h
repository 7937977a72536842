// Values that a process makes once and keeps.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>

#include "irk/scalar.h"

namespace irk {

/// Values by the numbers that they are made from: integrators of the same methods are made again and again, and what
/// they compute from the coefficients costs more than many a step. Threads may share one.
template <class Value>
class Kept {
 public:
  /// The value of `key`; make() makes it in the first call. What make() throws is passed on, and nothing is kept.
  template <class Make>
  std::shared_ptr<const Value> of(const std::string& key, const Make& make) {
    {
      const std::lock_guard lock(mutex_);
      const auto found = values_.find(key);
      if (found != values_.end()) return found->second;
    }
    auto value = std::make_shared<const Value>(make());
    const std::lock_guard lock(mutex_);
    if (values_.size() >= kMost) values_.clear();
    return values_.try_emplace(key, std::move(value)).first->second;
  }

 private:
  static constexpr std::size_t kMost = 500;  // a few megabytes
  std::mutex mutex_;
  std::unordered_map<std::string, std::shared_ptr<const Value>> values_;
};

/// Appends the bytes of a matrix or vector to a key.
inline void appendKey(const Eigen::Ref<const Mat<double>>& numbers, std::string& key) {
  key.append(reinterpret_cast<const char*>(numbers.data()), static_cast<std::size_t>(numbers.size()) * sizeof(double));
}

}  // namespace irk
