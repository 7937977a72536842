#include "experiments/store/calibration.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "experiments/base/clock.h"
#include "experiments/base/median.h"
#include "experiments/base/numbers.h"
#include "experiments/tables/environment.h"

namespace irk::store {
namespace {

constexpr double kDrift = 1.1;     // times are compared at a few per cent
constexpr double kMostSlow = 0.1;  // of the calibrations
constexpr std::size_t kFewest = 5;

// Gaussian elimination of a fixed matrix, as the runs do; no library and no part of the suite changes it.
double eliminate() {
  constexpr std::size_t kSize = 48;
  constexpr int kTimes = 12;
  std::array<std::array<double, kSize>, kSize> a;
  double sum = 0;
  for (int time = 0; time < kTimes; ++time) {
    for (std::size_t i = 0; i < kSize; ++i) {
      for (std::size_t j = 0; j < kSize; ++j)
        a[i][j] = 1 / static_cast<double>(1 + i + j + (i == j ? 0 : 1)) + (i == j ? 2 : 0);
    }
    for (std::size_t k = 0; k + 1 < kSize; ++k) {
      for (std::size_t i = k + 1; i < kSize; ++i) {
        const double factor = a[i][k] / a[k][k];
        for (std::size_t j = k; j < kSize; ++j) a[i][j] -= factor * a[k][j];
      }
    }
    sum += a[kSize - 1][kSize - 1];
  }
  return sum;
}

std::size_t columnOf(const Rows& rows, std::string_view name) {
  const auto& columns = rows.columns();
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
}

// An id that no other row has. `measured`: a number of the row.
std::string newId(const auto& measured) {
  return hexText(fnv1a(fmt::format("{} {} {} {} {}", hostName(), getpid(), dateText(), wallSeconds(), measured)));
}

std::string doubtsOf(const HostCalibrations& host, double fastest) {
  const double least = *std::min_element(host.seconds.begin(), host.seconds.end());
  const double most = *std::max_element(host.seconds.begin(), host.seconds.end());
  const auto slow =
      std::count_if(host.seconds.begin(), host.seconds.end(), [&](double s) { return s > kDrift * least; });
  const double share = static_cast<double>(slow) / static_cast<double>(host.seconds.size());
  std::string text;
  if (share >= kMostSlow) {
    text = fmt::format("{:.0f} % of the calibrations on {} took more than {} times the shortest one, up to {:.2f}",
                       100 * share, host.host, kDrift, most / least);
  }
  const double slower = median(host.seconds) / fastest;
  if (slower > kDrift) {
    text += fmt::format("{}{} is {:.2f} times slower than the fastest host with this processor",
                        text.empty() ? "" : "; ", host.host, slower);
  }
  return text;
}

}  // namespace

std::vector<std::string> calibrationColumns() { return {"calibration", "environment", "date", "calibration_s"}; }

double calibrationSeconds() {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double start = threadSeconds();
    volatile double result = eliminate();
    static_cast<void>(result);
    least = std::min(least, threadSeconds() - start);
  }
  return least;
}

TableRow calibrationRow(double seconds) {
  return {newId(seconds), thisEnvironment().front(), dateText(), numberText(seconds)};
}

std::string calibrationDoubts(std::vector<HostCalibrations> hosts) {
  std::erase_if(hosts, [](const auto& host) { return host.seconds.size() < kFewest; });
  std::map<std::string, double> fastest;  // median by processor
  for (const auto& host : hosts) {
    const auto [at, added] = fastest.try_emplace(host.processor, median(host.seconds));
    if (!added) at->second = std::min(at->second, median(host.seconds));
  }
  std::string text;
  for (const auto& host : hosts) {
    const auto doubts = doubtsOf(host, fastest[host.processor]);
    if (!doubts.empty()) text += (text.empty() ? "" : "; ") + doubts;
  }
  return text;
}

std::vector<std::string> coresColumns() {
  return {"trial", "environment", "date", "cores_at_once", "elimination_slower", "vectors_slower", "taken"};
}

TableRow coresRow(const CoresTrial& trial) {
  return {newId(trial.cores),          thisEnvironment().front(),     dateText(),
          std::to_string(trial.cores), numberText(trial.elimination), numberText(trial.vectors),
          trial.taken ? "1" : "0"};
}

std::string takenCores(const Rows& trials, const Rows& environments) {
  const auto host = columnOf(environments, "host"), cores = columnOf(trials, "cores_at_once"),
             taken = columnOf(trials, "taken");
  std::map<std::string, std::set<int>> by_host;
  trials.forEach([&](const Entry& entry) {
    const TableRow row = trials.row(entry);
    const auto environment = environments.find(keyNumber(trials.name(entry.environment)));
    if (row[taken] == "1") {
      by_host[environment ? environments.row(*environment)[host] : "unknown"].insert(std::stoi(row[cores]));
    }
  });
  std::string text;
  for (const auto& [name, numbers] : by_host) {
    text += fmt::format("{}{}{} on {}", text.empty() ? "" : ", ", fmt::join(numbers, " or "),
                        numbers.size() > 1 ? " in different passes" : "", name);
  }
  return text;
}

std::vector<HostCalibrations> calibrationsByHost(const Rows& calibrations, const Rows& environments) {
  const auto host = columnOf(environments, "host"), cpu = columnOf(environments, "cpu");
  const auto seconds = columnOf(calibrations, "calibration_s");
  std::map<std::string, std::pair<std::string, std::string>> known;  // host and processor by environment
  std::map<std::pair<std::string, std::string>, std::vector<double>> by_host;
  calibrations.forEach([&](const Entry& entry) {
    const auto& environment = calibrations.name(entry.environment);
    const auto [at, added] = known.try_emplace(environment, "unknown", "unknown");
    const auto its = added ? environments.find(keyNumber(environment)) : std::nullopt;
    if (its) {
      const TableRow row = environments.row(*its);
      at->second = {row[host], row[cpu]};
    }
    by_host[at->second].push_back(cellNumber(calibrations.row(entry)[seconds]));
  });
  std::vector<HostCalibrations> hosts;
  for (auto& [name, all] : by_host) hosts.push_back({name.first, name.second, std::move(all)});
  return hosts;
}

}  // namespace irk::store
