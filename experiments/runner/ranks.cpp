#include "experiments/runner/ranks.h"

#include <atomic>
#include <cstdlib>

namespace irk {
namespace {

class OneQueue final : public WorkQueue {
 public:
  explicit OneQueue(std::size_t count) : count_(count) {}
  std::optional<std::size_t> next() override {
    const std::size_t i = next_.fetch_add(1);
    return i < count_ ? std::optional(i) : std::nullopt;
  }

 private:
  std::size_t count_;
  std::atomic<std::size_t> next_ = 0;
};

class Alone final : public Ranks {
 public:
  int rank() const override { return 0; }
  int count() const override { return 1; }
  std::unique_ptr<WorkQueue> queue(std::size_t count, Given) override { return std::make_unique<OneQueue>(count); }
  void meet() override {}
  [[noreturn]] void abandon(int status) override { std::exit(status); }
};

}  // namespace

std::unique_ptr<Ranks> aloneRank() { return std::make_unique<Alone>(); }

}  // namespace irk
