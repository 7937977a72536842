#include "experiments/runner/cores/at_once.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/base/clock.h"
#include "experiments/base/median.h"
#include "experiments/runner/cores/children.h"
#include "experiments/runner/cores/processors.h"
#include "irk/misuse.h"

namespace irk::cores {
namespace {

constexpr double kSecondsOfTrial = 0.1;

double medianOf(const std::function<double()>& seconds) {
  std::vector<double> all;
  for (const double end = wallSeconds() + kSecondsOfTrial; all.empty() || wallSeconds() < end;) {
    all.push_back(seconds());
  }
  return median(all);
}

// a = b + s c over 48 MiB: far more than a core's own caches hold.
double vectorSeconds() {
  constexpr std::size_t kSize = std::size_t{1} << 21;
  std::vector<double> a(kSize, 0), b(kSize, 1), c(kSize, 2);
  return medianOf([&] {
    const double start = threadSeconds();
    for (std::size_t i = 0; i < kSize; ++i) a[i] = b[i] + 0.5 * c[i];
    std::swap(a, b);  // so that no pass can be left out
    return threadSeconds() - start;
  });
}

bool isUndisturbed(const store::CoresTrial& trial) {
  return trial.elimination <= kUndisturbed && trial.vectors <= kUndisturbed;
}

std::string coresText(std::size_t cores) { return cores == 1 ? "1 core" : fmt::format("{} cores", cores); }

}  // namespace

std::vector<store::CoresTrial> tryCores(std::size_t most, const MeasureCores& measure) {
  std::vector<store::CoresTrial> trials{{.cores = 1, .elimination = 1, .vectors = 1, .taken = true}};
  if (most < 2) return trials;
  KernelSeconds alone = measure(1);
  for (std::size_t cores = 2; trials.back().cores < most; cores = std::min(2 * cores, most)) {
    const KernelSeconds together = measure(cores), again = measure(1);
    alone = {std::min(alone.elimination, again.elimination), std::min(alone.vectors, again.vectors)};
    store::CoresTrial trial{.cores = cores,
                            .elimination = together.elimination / alone.elimination,
                            .vectors = together.vectors / alone.vectors,
                            .taken = false};
    trial.taken = isUndisturbed(trial);
    if (trial.taken) trials.back().taken = false;
    trials.push_back(trial);
    if (!trial.taken) break;
  }
  return trials;
}

KernelSeconds measureOn(const std::vector<int>& processors, std::size_t cores) {
  KernelSeconds slowest{0, 0};
  Children children({processors.begin(), processors.begin() + static_cast<std::ptrdiff_t>(cores)});
  for (std::size_t i = 0; i < cores; ++i) {
    children.begin(
        [] {
          return std::vector{medianOf(store::calibrationSeconds), vectorSeconds()};
        },
        [&slowest](const Answer& answer) {
          constexpr double kNever = std::numeric_limits<double>::infinity();
          const bool failed = !answer.failure.empty();
          slowest.elimination = std::max(slowest.elimination, failed ? kNever : answer.numbers[0]);
          slowest.vectors = std::max(slowest.vectors, failed ? kNever : answer.numbers[1]);
        });
  }
  children.finish();
  return slowest;
}

std::size_t takenOf(const std::vector<store::CoresTrial>& trials) {
  return std::ranges::find(trials, true, &store::CoresTrial::taken)->cores;
}

std::string textOf(const std::vector<store::CoresTrial>& trials, std::size_t available) {
  const std::size_t taken = takenOf(trials);
  auto text = fmt::format("{} of {} at once", taken, coresText(available));
  for (const auto& trial : trials) {
    if (trial.cores == 1 || std::isnan(trial.elimination)) continue;  // not tried
    if (!std::isfinite(trial.elimination)) {
      text += fmt::format("; on {} two fixed computations cannot be made", coresText(trial.cores));
      continue;
    }
    text += fmt::format("; on {} two fixed computations take {:.2f} and {:.2f} times as long as on one alone",
                        coresText(trial.cores), trial.elimination, trial.vectors);
    if (!trial.taken && trial.cores > taken) text += fmt::format(", allowed are {}", kUndisturbed);
  }
  return text;
}

void requireCores(int asked) {
  if (asked == 0 || asked == 1) return;
  const std::size_t available = physicalCores().size();
  if (asked > 0 && static_cast<std::size_t>(asked) <= available) return;
  throw Misuse(
      fmt::format("timing-cores = {}: an integer from 1 to {} is expected, the cores that this process may "
                  "use (OMP_PROC_BIND and GOMP_CPU_AFFINITY bind it to fewer), or 0 for as many as do not disturb each "
                  "other",
                  asked, available));
}

}  // namespace irk::cores
