#include "experiments/study/series_runs.h"

namespace irk {

RunSpec SeriesRuns::operator[](std::size_t i) const {
  RunSpec spec = base_;
  switch (swept_) {
    case Swept::kNothing:
      break;
    case Swept::kTolerances:
      spec.options.tolerances.rtol = spec.options.tolerances.atol = values_[i];
      break;
    case Swept::kStep:
      spec.options.step.control = StepControl::kFixed;
      spec.options.step.estimate = ErrorEstimate::kNone;
      spec.options.step.h = values_[i];
      break;
  }
  return spec;
}

}  // namespace irk
