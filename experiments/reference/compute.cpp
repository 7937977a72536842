#include "experiments/reference/compute.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "experiments/base/clock.h"
#include "experiments/reference/attempt.h"

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
  Assembly(const ReferenceTask& task, const std::vector<std::string>& times, const Attempted& made)
      : task_(task),
        times_(times),
        made_(made),
        spec_(referenceRun(task, 0)),
        scene_(makeScene<BigFloat>(spec_.scene, spec_.settings)) {}

  ComputedTask result() {
    if (!made_.failure.empty()) {
      computed_.problems.push_back(nameOf(task_) + ": " + made_.failure);
      return computed_;
    }
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
    const auto at = static_cast<Index>(j);
    const double scale = at < scene_.scale.size() ? scene_.scale[at] : 1;
    const auto found = agreedNumber(made_, i, j, task_.of.tolerance * kFiner, scale);
    if (!found) return;  // the output is not defined here
    ReferenceValue value{
        spec_.scene,   settingsText(spec_.settings), times_[i], component(j), found->value, found->accuracy,
        howText(task_)};
    if (isfinite(exact)) replace(value, exact, found->size);
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
  const Attempted& made_;
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

void expectTask(const ReferenceTask& task, Progress& progress) { progress.expect(nameOf(task)); }

ComputedTask compute(const ReferenceTask& task, const std::vector<std::string>& times, const ReferenceWatch& watch) {
  ReferenceSpecs specs;
  for (std::size_t i = 0; i < kReferenceRuns; ++i) specs[i] = referenceRun(task, i);
  const double start = wallSeconds();
  const auto made = attempt(specs, times, {.jobs = watch.jobs, .stop = watch.stop});
  if (watch.progress) watch.progress->finished(nameOf(task), wallSeconds() - start);
  return Assembly(task, times, made).result();
}

}  // namespace irk
