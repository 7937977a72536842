// Values that a process keeps once they are made.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>

#include "irk/scalar.h"

namespace irk {

/// A cache of values by a key, such as the coefficients that they are computed from: integrators of the same methods
/// are made again and again, and their schemes cost more than many steps. Threads may share it.
template <class Value>
class Kept {
 public:
  /// Returns the value of `key`, made by make() if it is not there. Threads that ask at the same time may each call
  /// make(); the first result is kept. An exception of make() is passed on, and nothing is kept.
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
  static constexpr std::size_t kMost = 500;  // then the cache is emptied; values in use live on
  std::mutex mutex_;
  std::unordered_map<std::string, std::shared_ptr<const Value>> values_;
};

/// Appends the bytes of a matrix or vector to a key.
template <int Columns>
void appendKey(const Eigen::Matrix<double, Eigen::Dynamic, Columns>& numbers, std::string& key) {
  key.append(reinterpret_cast<const char*>(numbers.data()), static_cast<std::size_t>(numbers.size()) * sizeof(double));
}

}  // namespace irk
