#include "experiments/reference/attempt.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <mutex>

#include "core/base/parallel_loop.h"
#include "experiments/base/clock.h"

namespace irk {
namespace {

// Below this part of the runs' limit, and of a run's course, its cost cannot be told.
constexpr double kLeastPart = 0.03;
// A run with the stricter tolerance costs about this much more than one with the looser tolerance.
constexpr double kStricter = 1.3;
constexpr double kProgressInterval = 0.1;  // s

bool isStrict(std::size_t run) { return run >= kReferenceRuns / 2; }

class Attempt {
 public:
  Attempt(const ReferenceSpecs& specs, const std::vector<std::string>& times, const AttemptWatch& watch)
      : specs_(specs), times_(times), watch_(watch), costs_(watch.cpu_s, watch.course) {}

  // The looser runs first: they tell what the stricter ones will cost.
  Attempted made() {
    ParallelLoop loop;
#pragma omp parallel for schedule(dynamic, 1) num_threads(watch_.jobs)
    for (std::size_t i = 0; i < kReferenceRuns; ++i) loop.turn(i, [&] { makeRun(i); });
    loop.rethrow();
    return std::move(result_);
  }

 private:
  void makeRun(std::size_t i) {
    auto run = integrated(specs_[i], times_,
                          {.stop = watch_.stop, .refuse = [this, i](double t, double s) { return refuse(i, t, s); }});
    const std::lock_guard lock(mutex_);
    if (!run.failure.empty() && result_.failure.empty()) {
      result_.failure = run.failure;
      useful_ = run.rows.empty() ? -std::numeric_limits<double>::infinity()
                                 : std::strtod(times_[run.rows.size() - 1].c_str(), nullptr);
    }
    result_.runs[i] = std::move(run);
  }

  std::string refuse(std::size_t run, double t, double cpu_s) {
    const std::lock_guard lock(mutex_);
    if (t >= useful_) return "another run has failed";
    const double now = wallSeconds();
    if (watch_.progress && now - shown_ > kProgressInterval) {
      shown_ = now;
      watch_.progress(costs_.spent() / costs_.expected());
    }
    return costs_.reached(run, t, cpu_s);
  }

  const ReferenceSpecs& specs_;
  const std::vector<std::string>& times_;
  const AttemptWatch& watch_;
  std::mutex mutex_;
  AttemptCosts costs_;
  Attempted result_;
  double useful_ = std::numeric_limits<double>::infinity();  // beyond this time not all four runs will have values
  double shown_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

std::string AttemptCosts::reached(std::size_t run, double t, double cpu_s) {
  runs_[run] = {cpu_s, course_.known() ? course_.part(t) : 0};
  if (spent() > limit_) return fmt::format("longer than {:g} s of CPU time", limit_);
  // The less is done, the less certain is the estimate: at first it must be twice the limit.
  const double all = expected(), ahead = 1 - spent() / all;
  if (spent() < kLeastPart * limit_ || !(all > limit_ * (1 + ahead * ahead))) return {};
  return fmt::format("it would take about {:.0f} s of CPU time, more than {:g}", all, limit_);
}

double AttemptCosts::spent() const {
  double sum = 0;
  for (const Run& run : runs_) sum += run.cpu_s;
  return sum;
}

double AttemptCosts::expected() const {
  double known = 0, weight = 0, weight_of_all = 0;  // in costs of a run with the looser tolerance
  for (std::size_t i = 0; i < kReferenceRuns; ++i) {
    const double cost = isStrict(i) ? kStricter : 1;
    weight_of_all += cost;
    if (runs_[i].part < kLeastPart) continue;
    known += runs_[i].cpu_s / runs_[i].part;
    weight += cost;
  }
  return weight == 0 ? std::numeric_limits<double>::quiet_NaN() : known * weight_of_all / weight;
}

Attempted attempt(const ReferenceSpecs& specs, const std::vector<std::string>& times, const AttemptWatch& watch) {
  return Attempt(specs, times, watch).made();
}

}  // namespace irk
