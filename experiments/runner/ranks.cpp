#include "experiments/runner/ranks.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <utility>

#include "experiments/base/interrupt.h"
#include "experiments/tables/environment.h"

namespace irk {
namespace {

class Alone final : public Ranks {
 public:
  int rank() const override { return 0; }
  int count() const override { return 1; }
  std::unique_ptr<WorkQueue> queue(const std::function<Schedule()>& schedule, Given) override {
    return std::make_unique<ProcessQueue>(schedule());
  }
  void meet() override {}
  std::vector<std::string> hosts() override { return {hostName()}; }
  bool asTheFirst(bool said) override { return said; }
  [[noreturn]] void abandon(int status) override { std::exit(status); }
};

}  // namespace

ProcessQueue::Now ProcessQueue::nextNow() {
  if (closed_ || interruptFlag()) return {{}, true};
  auto piece = schedule_.next();
  const bool over = !piece && schedule_.isOver();
  return {std::move(piece), over};
}

ProcessQueue::Now ProcessQueue::tryNext() {
  const std::lock_guard lock(mutex_);
  return nextNow();
}

std::optional<Piece> ProcessQueue::next() {
  constexpr auto kLookForInterrupts = std::chrono::milliseconds(100);
  std::unique_lock lock(mutex_);
  while (true) {
    auto [piece, over] = nextNow();
    if (piece || over) {
      if (over) changed_.notify_all();  // `next` may have ended the schedule
      return std::move(piece);
    }
    changed_.wait_for(lock, kLookForInterrupts);
  }
}

void ProcessQueue::record(const Piece& piece, const RunFacts& facts) {
  const std::lock_guard lock(mutex_);
  schedule_.record(piece, facts);
  changed_.notify_all();
}

void ProcessQueue::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

std::unique_ptr<Ranks> aloneRank() { return std::make_unique<Alone>(); }

std::vector<int> timingRanks(const std::vector<std::string>& hosts) {
  std::vector<int> ranks;
  for (auto host = hosts.begin(); host != hosts.end(); ++host) {
    if (std::find(hosts.begin(), host, *host) == host) ranks.push_back(static_cast<int>(host - hosts.begin()));
  }
  return ranks;
}

}  // namespace irk
