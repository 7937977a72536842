#include "experiments/base/studies_progress.h"

#include <fmt/format.h>

#include "experiments/base/progress.h"

namespace irk {

std::string StudiesProgress::line(std::size_t next, double seconds) const {
  constexpr double kLeastPart = 0.01;
  std::size_t runs = 0, all_runs = 0;
  double time = 0, all_time = 0;  // in the unit of time_per_run
  for (std::size_t i = 0; i < studies_.size(); ++i) {
    const ExpectedStudy& study = studies_[i];
    const double expected = static_cast<double>(study.runs) * study.time_per_run;
    all_runs += study.runs;
    all_time += expected;
    if (i < next) {
      runs += study.runs;
      time += expected;
    }
  }
  const std::string start = fmt::format("study {} of {}, {}: {} of {} runs done", next + 1, studies_.size(),
                                        studies_[next].id, runs, all_runs);
  if (time <= kLeastPart * all_time) return start;
  return fmt::format("{}, about {} left for all studies", start, durationText(seconds / time * (all_time - time)));
}

}  // namespace irk
