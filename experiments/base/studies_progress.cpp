#include "experiments/base/studies_progress.h"

#include <fmt/format.h>

#include "experiments/base/progress.h"

namespace irk {

std::size_t StudiesProgress::runsBefore(std::size_t study) const {
  std::size_t runs = 0;
  for (std::size_t i = 0; i < study; ++i) runs += studies_[i].second;
  return runs;
}

std::string StudiesProgress::line(std::size_t next, double seconds) const {
  const std::size_t done = runsBefore(next), all = runsBefore(studies_.size());
  const std::string start = fmt::format("study {} of {}, {}: {} of {} runs done, {} %", next + 1, studies_.size(),
                                        studies_[next].first, done, all, all == 0 ? 100 : 100 * done / all);
  if (done == 0) return start;
  const double left = seconds / static_cast<double>(done) * static_cast<double>(all - done);
  return fmt::format("{}, about {} left for all studies", start, durationText(left));
}

}  // namespace irk
