#include "experiments/reference/compute.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <span>

#include "core/base/parallel_loop.h"
#include "experiments/base/clock.h"
#include "experiments/reference/agreement.h"
#include "experiments/reference/integration.h"

namespace irk {
namespace {

// Accuracy of exact values: the closed forms lose some of their 50 digits.
constexpr double kExact = 1e-38;

using Rows = std::vector<std::vector<BigFloat>>;  // of components and outputs, for each of a task's times

std::string nameOf(const ReferenceTask& task) {
  return fmt::format("{}{}{}", task.scene, task.of.settings.empty() ? "" : " ", task.of.settings);
}

// The values of the closed form at each time; NaN where it gives none.
Rows exactRows(const Scene<BigFloat>& scene, const std::vector<std::string>& times) {
  Rows rows;
  for (const auto& t : times) {
    if (scene.exact) {
      rows.push_back(componentsAndOutputs(scene, scene.exact(BigFloat(t))));
    } else {
      rows.emplace_back(scene.names.size() + scene.outputs.size(), std::numeric_limits<BigFloat>::quiet_NaN());
    }
  }
  return rows;
}

std::string howText(const ReferenceTask& task) {
  const bool fixed = task.of.step > 0;
  const double coarse = fixed ? task.of.step : task.of.tolerance;
  return fmt::format("mp50: {} and {}; {} {:g} and {:g}; locate; {}", kFirstMethod, task.second, fixed ? "step" : "tol",
                     coarse, coarse * (fixed ? 0.5 : kFiner), idOf(task.formulation));
}

class Assembly {
 public:
  Assembly(const ReferenceTask& task, const std::vector<std::string>& times, std::span<const Integrated> runs)
      : task_(task),
        times_(times),
        runs_(runs),
        spec_(referenceRun(task, 0)),
        scene_(makeScene<BigFloat>(spec_.scene, spec_.settings)) {}

  ComputedTask result() {
    for (const auto& run : runs_) {
      if (!run.failure.empty()) computed_.problems.push_back(nameOf(task_) + ": " + run.failure);
    }
    if (!computed_.problems.empty()) return computed_;
    const Rows exact = exactRows(scene_, times_);
    for (std::size_t i = 0; i < times_.size(); ++i) {
      for (std::size_t j = 0; j < exact[i].size(); ++j) addValue(i, j, exact[i][j]);
    }
    return computed_;
  }

 private:
  const std::string& component(std::size_t j) const {
    const std::size_t n = scene_.names.size();
    return j < n ? scene_.names[j] : scene_.outputs[j - n].name;
  }

  void addValue(std::size_t i, std::size_t j, const BigFloat& exact) {
    std::array<BigFloat, kReferenceRuns> values;
    for (std::size_t run = 0; run < kReferenceRuns; ++run) values[run] = runs_[run].rows[i][j];
    if (!isfinite(values.back())) return;  // the output is not defined here
    const auto at = static_cast<Index>(j);
    const double scale = at < scene_.scale.size() ? scene_.scale[at] : 1;
    const double size = std::max(std::abs(static_cast<double>(values.back())), scale);
    const AgreedValue found = agreed(values, task_.of.tolerance * kFiner * size);
    ReferenceValue value{
        spec_.scene,   settingsText(spec_.settings), times_[i], component(j), found.value, found.accuracy,
        howText(task_)};
    if (isfinite(exact)) replace(value, exact, size);
    computed_.values.push_back(std::move(value));
  }

  // Replaces the value by the exact one, or removes it if the integrations contradict it.
  void replace(ReferenceValue& value, const BigFloat& exact, double size) {
    const auto error = static_cast<double>(BigFloat(abs(exact - value.value)));
    if (error > value.accuracy) {
      computed_.problems.push_back(fmt::format("{}: exact {}, integrated {}, which agree to {:g} among themselves",
                                               value.place(), exact.str(30), value.value.str(30), value.accuracy));
    }
    value.source = fmt::format("exact; {} agree to {:g}", value.source, value.accuracy);
    value.value = exact;
    value.accuracy = roundedUp(kExact * size);
  }

  const ReferenceTask& task_;
  const std::vector<std::string>& times_;
  std::span<const Integrated> runs_;
  RunSpec spec_;
  Scene<BigFloat> scene_;
  ComputedTask computed_;
};

}  // namespace

std::string ReferenceValue::place() const {
  return fmt::format("{}{}{}, {} at t = {}", scene, settings.empty() ? "" : " ", settings, component, t);
}

bool samePlace(const ReferenceValue& a, const ReferenceValue& b) {
  return a.scene == b.scene && a.settings == b.settings && a.component == b.component && BigFloat(a.t) == BigFloat(b.t);
}

void expectRuns(const ReferenceTask& task, Progress& progress) {
  for (std::size_t run = 0; run < kReferenceRuns; ++run) progress.expect(nameOf(task));
}

std::vector<ComputedTask> compute(const std::vector<ReferenceTask>& tasks,
                                  const std::vector<std::vector<std::string>>& times, const ReferenceWatch& watch) {
  std::vector<Integrated> runs(kReferenceRuns * tasks.size());
  std::mutex mutex;
  ParallelLoop loop;
  // The last runs of a task have the finer tolerance and take longest: start with them.
#pragma omp parallel for schedule(dynamic, 1) num_threads(watch.jobs)
  for (std::size_t turn = 0; turn < runs.size(); ++turn) {
    loop.turn(turn, [&] {
      const std::size_t i = runs.size() - 1 - turn, task = i / kReferenceRuns;
      const double start = threadSeconds();
      runs[i] = integrated(referenceRun(tasks[task], i % kReferenceRuns), times[task], {.stop = watch.stop});
      const std::lock_guard lock(mutex);
      if (watch.progress) watch.progress->finished(nameOf(tasks[task]), threadSeconds() - start);
    });
  }
  loop.rethrow();
  std::vector<ComputedTask> computed;
  for (std::size_t task = 0; task < tasks.size(); ++task) {
    const std::span all(runs);
    computed.push_back(Assembly(tasks[task], times[task], all.subspan(kReferenceRuns * task, kReferenceRuns)).result());
  }
  return computed;
}

}  // namespace irk
