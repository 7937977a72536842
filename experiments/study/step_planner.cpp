#include "experiments/study/step_planner.h"

#include <algorithm>
#include <cmath>

namespace irk {
namespace {

// Errors this far above round-off: their noise of a thousandth does not change a slope.
constexpr double kAboveRoundOff = 1e3;
// For error = C h^p (1 + c h), the difference of two consecutive slopes equals the remaining error of the second
// slope; each difference is half the previous one.
constexpr double kSettled = 0.04;
constexpr int kSettledProbes = 4;
// The measured steps: kPoints steps over a factor kRange, or over kDecades decades of the error if that factor is
// smaller. For high orders, larger errors are not asymptotic.
constexpr int kPoints = 8;
constexpr double kRange = 4;
constexpr double kDecades = 12;

double slopeBetween(double h1, double e1, double h2, double e2) { return std::log(e1 / e2) / std::log(h1 / h2); }

}  // namespace

StepPlanner::StepPlanner(std::vector<double> steps, double epsilon)
    : steps_(std::move(steps)), floor_(kAboveRoundOff * epsilon) {}

std::optional<std::size_t> StepPlanner::next() {
  if (probing_) {
    if (const auto probe = nextProbe()) return probe;
    probing_ = false;
  }
  if (!planned_) plan();
  if (plan_.empty()) return {};
  const std::size_t index = plan_.back();
  plan_.pop_back();
  return index;
}

std::optional<std::size_t> StepPlanner::nextProbe() const {
  if (steps_.empty()) return {};
  if (runs_.empty()) return 0;
  bool all = true, any = false;
  for (std::size_t group = 0; group < std::tuple_size_v<GroupErrors>; ++group) {
    const auto probes = probesOf(group);
    any = any || !probes.empty();
    all = all && (probes.empty() || finished(group));
  }
  if (any && all) return {};
  const double wanted = steps_[runs_.rbegin()->first] / 2;
  const auto at = std::find_if(steps_.begin(), steps_.end(), [wanted](double h) { return h <= wanted * (1 + 1e-9); });
  if (at == steps_.end()) return {};
  return static_cast<std::size_t>(at - steps_.begin());
}

// From coarse to fine; only probes with a finite error.
std::vector<StepPlanner::Probe> StepPlanner::probesOf(std::size_t group) const {
  std::vector<Probe> probes;
  for (const auto& [index, errors] : runs_) {
    if (std::isfinite(errors[group])) probes.push_back({steps_[index], errors[group]});
  }
  return probes;
}

bool StepPlanner::finished(std::size_t group) const {
  const auto probes = probesOf(group);
  if (probes.back().error <= floor_) return true;
  if (probes.size() < kSettledProbes) return false;
  std::vector<double> slopes;
  for (auto p = probes.end() - kSettledProbes; p + 1 != probes.end(); ++p) {
    slopes.push_back(slopeBetween(p->h, p->error, (p + 1)->h, (p + 1)->error));
  }
  const double before = std::abs(slopes[1] - slopes[0]), last = std::abs(slopes[2] - slopes[1]);
  return before <= 2 * kSettled && last <= kSettled;
}

// The step at which the error reaches the floor, or the last probe's step if no probe is below it.
std::optional<double> StepPlanner::smallestUseful(std::size_t group) const {
  const auto probes = probesOf(group);
  const auto below = std::find_if(probes.begin(), probes.end(), [this](auto& p) { return p.error <= floor_; });
  if (below == probes.begin()) return {};
  const Probe& last = *(below - 1);
  if (below == probes.end() || below - probes.begin() < 2) return last.h;
  const Probe& before = *(below - 2);
  const double slope = slopeBetween(before.h, before.error, last.h, last.error);
  if (!(slope > 0)) return last.h;
  return std::clamp(last.h * std::pow(floor_ / last.error, 1 / slope), below->h, last.h);
}

// Ratio of the largest to the smallest measured step, from the slope of the last two probes above the floor.
double StepPlanner::rangeOf(std::size_t group) const {
  auto probes = probesOf(group);
  std::erase_if(probes, [this](const Probe& p) { return p.error <= floor_; });
  if (probes.size() < 2) return kRange;
  const Probe &before = *(probes.end() - 2), &last = probes.back();
  const double slope = slopeBetween(before.h, before.error, last.h, last.error);
  return slope > 0 ? std::min(kRange, std::pow(10, kDecades / slope)) : kRange;
}

void StepPlanner::plan() {
  planned_ = true;
  for (std::size_t group = 0; group < std::tuple_size_v<GroupErrors>; ++group) {
    const auto least = smallestUseful(group);
    if (!least) continue;
    const double range = rangeOf(group);
    for (int k = 0; k < kPoints; ++k) {
      const std::size_t index = nearest(*least * std::pow(range, k / (kPoints - 1.0)));
      if (!runs_.contains(index)) plan_.push_back(index);
    }
  }
  std::sort(plan_.begin(), plan_.end(), std::greater<>());
  plan_.erase(std::unique(plan_.begin(), plan_.end()), plan_.end());
}

std::size_t StepPlanner::nearest(double h) const {
  const auto at = std::min_element(steps_.begin(), steps_.end(), [h](double a, double b) {
    return std::abs(std::log(a / h)) < std::abs(std::log(b / h));
  });
  return static_cast<std::size_t>(at - steps_.begin());
}

}  // namespace irk
