#include "experiments/runner/ranks.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <utility>

#include "experiments/tables/environment.h"

namespace irk {
namespace {

class OneQueue final : public WorkQueue {
 public:
  explicit OneQueue(std::vector<std::size_t> order) : order_(std::move(order)) {}
  std::optional<std::size_t> next() override {
    const std::size_t i = next_.fetch_add(1);
    return i < order_.size() ? std::optional(order_[i]) : std::nullopt;
  }

 private:
  std::vector<std::size_t> order_;
  std::atomic<std::size_t> next_ = 0;
};

class Alone final : public Ranks {
 public:
  int rank() const override { return 0; }
  int count() const override { return 1; }
  std::unique_ptr<WorkQueue> queue(std::vector<std::size_t> order, Given) override {
    return std::make_unique<OneQueue>(std::move(order));
  }
  void meet() override {}
  std::vector<std::string> hosts() override { return {hostName()}; }
  bool asTheFirst(bool said) override { return said; }
  [[noreturn]] void abandon(int status) override { std::exit(status); }
};

}  // namespace

std::unique_ptr<Ranks> aloneRank() { return std::make_unique<Alone>(); }

std::vector<int> timingRanks(const std::vector<std::string>& hosts) {
  std::vector<int> ranks;
  for (auto host = hosts.begin(); host != hosts.end(); ++host) {
    if (std::find(hosts.begin(), host, *host) == host) ranks.push_back(static_cast<int>(host - hosts.begin()));
  }
  return ranks;
}

}  // namespace irk
