#include "experiments/reference/course.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/numbers.h"
#include "experiments/reference/integration.h"
#include "experiments/runs/fields.h"

namespace irk {

double Course::part(double t) const {
  const auto after = std::upper_bound(times_.begin(), times_.end(), t);
  if (after == times_.begin()) return 0;
  if (after == times_.end()) return 1;
  const double before = *(after - 1);
  const double steps = static_cast<double>(after - 1 - times_.begin()) + (t - before) / (*after - before);
  return steps / static_cast<double>(times_.size() - 1);
}

Course courseOf(const ReferenceQuestion& question, double cpu_s, const std::atomic<bool>* stop) {
  const std::string end = numberText(question.t_end);
  const RunSpec spec = resolved(parseSpec(fmt::format(
      "scene={};settings={};configuration=embedded;method=radau_iia_5;formulation=index2;discontinuity={};rtol=1e-7;"
      "atol=1e-7;t_end={}",
      question.scene, settingsText(question.settings), question.smooth ? "smooth" : "locate", end)));
  std::vector<double> times;
  const auto note = [&](double t, double spent) {
    times.push_back(t);
    return std::string(spent > cpu_s ? "too long" : "");
  };
  if (!integrated(spec, {end}, {.stop = stop, .refuse = note}).failure.empty()) return {};
  times.push_back(question.t_end);
  return Course(std::move(times));
}

}  // namespace irk
