#include "experiments/base/time_left.h"

#include <algorithm>

namespace irk {
namespace {

constexpr double kNewest = 0.3;  // weight of the newest run in a kind's average
// Further kinds count as one, so that the memory does not grow with the number of runs.
constexpr std::size_t kMaxKinds = 20'000;

}  // namespace

TimeLeft::Kind& TimeLeft::kindOf(const std::string& name) {
  const auto at = kinds_.find(name);
  if (at != kinds_.end()) return at->second;
  return kinds_[kinds_.size() < kMaxKinds ? name : "others"];
}

void TimeLeft::expect(const std::string& kind, std::size_t runs) { kindOf(kind).left += runs; }

void TimeLeft::made(const std::string& kind, double seconds) {
  Kind& k = kindOf(kind);
  k.left -= std::min<std::size_t>(k.left, 1);
  k.seconds = k.made == 0 ? seconds : k.seconds + kNewest * (seconds - k.seconds);
  ++k.made;
  ++made_;
  spent_ += seconds;
}

void TimeLeft::dropped(const std::string& kind, std::size_t runs) {
  Kind& k = kindOf(kind);
  k.left -= std::min(k.left, runs);
}

double TimeLeft::left() const {
  const double mean = made_ == 0 ? 0 : spent_ / static_cast<double>(made_);
  double seconds = 0;
  for (const auto& [name, kind] : kinds_) {
    seconds += static_cast<double>(kind.left) * (kind.made == 0 ? mean : kind.seconds);
  }
  return seconds;
}

std::size_t TimeLeft::guessed() const {
  std::size_t runs = 0;
  for (const auto& [name, kind] : kinds_) {
    if (kind.made == 0) runs += kind.left;
  }
  return runs;
}

}  // namespace irk
