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
// With this many probes their last slope predicts the next one.
constexpr int kFewestProbes = 3;
// Errors that grow as the step shrinks and lie below this many floors are round-off, which for algebraic unknowns is
// divided by h. Larger ones show an order below zero.
constexpr double kSmall = 1e4;
// The measured steps span a factor kRange, or kDecades decades of the error if that factor is smaller (for high orders
// larger errors are not asymptotic). Where the slope has settled, a few steps between the probes narrow its confidence.
// Where round-off comes first, the slope still changes, and the fit needs more steps.
constexpr int kPointsSettled = 5;
constexpr int kPointsChanging = 8;
constexpr double kRange = 4;
constexpr double kDecades = 12;

double slopeBetween(double h1, double e1, double h2, double e2) { return std::log(e1 / e2) / std::log(h1 / h2); }

// The error of the next probe, after errors e1 and e2 at the steps h1 > h2.
double nextError(double h1, double e1, double h2, double e2) {
  return e2 * std::pow(0.5, slopeBetween(h1, e1, h2, e2));
}

}  // namespace

StepPlanner::StepPlanner(std::vector<double> steps, double epsilon)
    : steps_(std::move(steps)), floor_(kAboveRoundOff * epsilon), small_(kSmall * floor_) {}

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

// The probes before the error reaches the floor, or before it is small and no longer shrinks.
std::vector<StepPlanner::Probe> StepPlanner::aboveRoundOff(std::size_t group) const {
  auto probes = probesOf(group);
  const auto below = std::find_if(probes.begin(), probes.end(), [this](auto& p) { return p.error <= floor_; });
  const auto grows = [this](auto& p, auto& q) { return q.error <= small_ && q.error >= p.error; };
  const auto least = std::adjacent_find(probes.begin(), probes.end(), grows);
  probes.erase(std::min(below, least), probes.end());
  return probes;
}

bool StepPlanner::finished(std::size_t group) const {
  const auto probes = probesOf(group);
  const double last_error = probes.back().error;
  if (last_error <= floor_) return true;
  if (probes.size() < kFewestProbes) return false;
  const Probe& previous = *(probes.end() - 2);
  if (last_error <= small_ && last_error >= previous.error) return true;
  if (nextError(previous.h, previous.error, probes.back().h, last_error) <= floor_) return true;
  return settled(group);
}

bool StepPlanner::settled(std::size_t group) const {
  const auto probes = probesOf(group);
  if (probes.size() < kSettledProbes) return false;
  std::vector<double> slopes;
  for (auto p = probes.end() - kSettledProbes; p + 1 != probes.end(); ++p) {
    slopes.push_back(slopeBetween(p->h, p->error, (p + 1)->h, (p + 1)->error));
  }
  const double before = std::abs(slopes[1] - slopes[0]), last = std::abs(slopes[2] - slopes[1]);
  return before <= 2 * kSettled && last <= kSettled;
}

// The step at which the error reaches the floor, by the last slope above it; no smaller than the next probe, made or
// predicted. The last probe's step if no probe reaches the floor.
std::optional<double> StepPlanner::smallestUseful(std::size_t group) const {
  const auto all = probesOf(group), probes = aboveRoundOff(group);
  if (probes.empty()) return {};
  const Probe& last = probes.back();
  if (probes.size() < 2) return last.h;
  const Probe& before = *(probes.end() - 2);
  const bool predicted = nextError(before.h, before.error, last.h, last.error) <= floor_;
  if (all.size() == probes.size() && !predicted) return last.h;
  const double slope = slopeBetween(before.h, before.error, last.h, last.error);
  if (!(slope > 0)) return last.h;
  const double next = all.size() > probes.size() ? all[probes.size()].h : last.h / 2;
  return std::clamp(last.h * std::pow(floor_ / last.error, 1 / slope), next, last.h);
}

// Ratio of the largest to the smallest measured step, from the slope of the last two probes above the floor.
double StepPlanner::rangeOf(std::size_t group) const {
  const auto probes = aboveRoundOff(group);
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
    const int points = settled(group) ? kPointsSettled : kPointsChanging;
    const double ratio = std::pow(rangeOf(group), 1 / (points - 1.0));
    for (int k = 0; k < points; ++k) {
      const double h = *least * std::pow(ratio, k);
      if (!measuredNear(h, ratio, group)) plan_.push_back(nearest(h));
    }
  }
  std::sort(plan_.begin(), plan_.end(), std::greater<>());
}

// Whether a run that shows the error of this group has a step within half a ratio of h, or will have it: components
// share their steps.
bool StepPlanner::measuredNear(double h, double ratio, std::size_t group) const {
  const double distance = 0.5 * std::log(ratio) * (1 + 1e-9);
  const auto near = [&](std::size_t index) { return std::abs(std::log(steps_[index] / h)) <= distance; };
  const auto known = [&](const auto& run) { return std::isfinite(run.second[group]) && near(run.first); };
  const std::size_t candidate = nearest(h);
  return runs_.contains(candidate) || std::any_of(runs_.begin(), runs_.end(), known) ||
         std::any_of(plan_.begin(), plan_.end(), near) ||
         std::find(plan_.begin(), plan_.end(), candidate) != plan_.end();
}

std::size_t StepPlanner::nearest(double h) const {
  const auto at = std::min_element(steps_.begin(), steps_.end(), [h](double a, double b) {
    return std::abs(std::log(a / h)) < std::abs(std::log(b / h));
  });
  return static_cast<std::size_t>(at - steps_.begin());
}

}  // namespace irk
