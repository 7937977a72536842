#include "experiments/reference/attempt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "core/base/parallel_loop.h"
#include "experiments/base/clock.h"

namespace irk {
namespace {

constexpr double kProgressInterval = 0.1;  // s

class Attempt {
 public:
  Attempt(const ReferenceSpecs& specs, const std::vector<std::string>& times, const AttemptWatch& watch)
      : specs_(specs), times_(times), watch_(watch) {}

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

  // Why the run must end now, in one line; empty: it need not.
  std::string refuse(std::size_t run, double t, double cpu_s) {
    const std::lock_guard lock(mutex_);
    if (t >= useful_) return "another run has failed";
    spent_[run] = cpu_s;
    const double all = std::accumulate(spent_.begin(), spent_.end(), 0.0), now = wallSeconds();
    if (watch_.progress && now - shown_ > kProgressInterval) {
      shown_ = now;
      watch_.progress(all);
    }
    return all > watch_.cpu_s ? fmt::format("the four runs take more than {:g} s of CPU time", watch_.cpu_s) : "";
  }

  const ReferenceSpecs& specs_;
  const std::vector<std::string>& times_;
  const AttemptWatch& watch_;
  std::mutex mutex_;
  std::array<double, kReferenceRuns> spent_{};
  Attempted result_;
  double useful_ = std::numeric_limits<double>::infinity();  // beyond this time not all four runs will have values
  double shown_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

bool Attempted::hasReached(std::size_t time) const {
  return std::all_of(runs.begin(), runs.end(), [time](const Integrated& run) { return run.rows.size() > time; });
}

Attempted attempt(const ReferenceSpecs& specs, const std::vector<std::string>& times, const AttemptWatch& watch) {
  return Attempt(specs, times, watch).made();
}

std::optional<AgreedNumber> agreedNumber(const Attempted& made, std::size_t time, std::size_t number, double least,
                                         double scale) {
  std::array<BigFloat, kReferenceRuns> values;
  for (std::size_t run = 0; run < kReferenceRuns; ++run) values[run] = made.runs[run].rows[time][number];
  if (!std::all_of(values.begin(), values.end(), [](const BigFloat& x) { return isfinite(x); })) return {};
  const double size = std::max(std::abs(static_cast<double>(values.back())), scale);
  return AgreedNumber{agreed(values, least * size), size};
}

}  // namespace irk
