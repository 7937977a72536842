#include "experiments/runner/shards.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <queue>

#include "experiments/base/numbers.h"
#include "experiments/runner/schedule/costs.h"
#include "irk/misuse.h"

namespace irk {
namespace {

constexpr int kMaxShards = 1'000'000;

const char* setting(const char* name) {
  const char* value = std::getenv(name);
  return value && *value ? value : nullptr;
}

int fromEnvironment(const char* name) {
  return static_cast<int>(parseInteger(name, std::getenv(name), Range::integers(0, kMaxShards)));
}

// The task's index i and, if the environment has it, their number n, else 0.
Shard fromArrayJob() {
  if (setting("SLURM_ARRAY_TASK_ID")) {
    const int first = setting("SLURM_ARRAY_TASK_MIN") ? fromEnvironment("SLURM_ARRAY_TASK_MIN") : 1;
    const int count = setting("SLURM_ARRAY_TASK_COUNT") ? fromEnvironment("SLURM_ARRAY_TASK_COUNT") : 0;
    return {fromEnvironment("SLURM_ARRAY_TASK_ID") - first + 1, count};
  }
  for (const char* name : {"PBS_ARRAY_INDEX", "SGE_TASK_ID"}) {
    if (setting(name)) return {fromEnvironment(name), 0};
  }
  throw Misuse(
      "shard = 'auto': this is no array job, neither SLURM_ARRAY_TASK_ID nor PBS_ARRAY_INDEX nor SGE_TASK_ID "
      "is set");
}

Shard checked(Shard shard, std::string_view text) {
  if (shard.index < 1 || shard.index > shard.count) {
    throw Misuse(fmt::format("shard = '{}': {} of {}; 1 <= i <= n is allowed", text, shard.index, shard.count));
  }
  return shard;
}

}  // namespace

Shard parseShard(std::string_view text) {
  const auto slash = text.find('/');
  const auto index = text.substr(0, slash);
  if (slash == std::string_view::npos) {
    if (index != "auto") throw Misuse(fmt::format("shard = '{}' is not of the form i/n, auto/n or auto", text));
    const Shard shard = fromArrayJob();
    if (shard.count == 0) {
      throw Misuse("shard = 'auto': the array job does not say how many tasks it has; give auto/n");
    }
    return checked(shard, text);
  }
  const int count = static_cast<int>(parseInteger("shard", text.substr(slash + 1), Range::integers(1, kMaxShards)));
  if (index == "auto") return checked({fromArrayJob().index, count}, text);
  return {static_cast<int>(parseInteger("shard", index, Range::integers(1, count))), count};
}

std::vector<int> balanced(const std::vector<double>& cost, int shards) {
  std::vector<int> shard(cost.size(), 1);
  std::vector<std::size_t> order(cost.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return cost[a] > cost[b]; });
  using Load = std::pair<double, int>;
  std::priority_queue<Load, std::vector<Load>, std::greater<>> least;
  for (int i = 1; i <= shards; ++i) least.push({0, i});
  for (const auto i : order) {
    const auto [load, index] = least.top();
    least.pop();
    shard[i] = index;
    least.push({load + cost[i], index});
  }
  return shard;
}

std::vector<int> shardsOf(const Study& study, int shards) {
  if (shards == 1) return std::vector<int>(study.series.size(), 1);
  // Whole numbers have exact sums: hosts on which pow differs in the last bit find the same shards.
  std::vector<double> costs;
  for (const Series& series : study.series) costs.push_back(std::round(1000 * expectedCost(series)));
  return balanced(costs, shards);
}

namespace {

// A word for the lines that sbatch reads: other characters become `_`.
std::string plainWord(std::string text) {
  for (char& c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.';
    if (!plain) c = '_';
  }
  return text;
}

}  // namespace

std::string slurmScript(const Study& study, const std::string& run_command, const std::string& merge_command,
                        int shards, int jobs) {
  return fmt::format(
      "#!/bin/bash\n"
      "# {0}: submit with sbatch. When all jobs have ended:\n"
      "#   {4}\n"
      "#SBATCH --job-name=irk-{0}\n"
      "#SBATCH --array=1-{1}\n"
      "#SBATCH --ntasks=1\n"
      "#SBATCH --cpus-per-task={2}\n"
      "#SBATCH --output=irk-{0}-%a.log\n"
      "{3}\n",
      plainWord(study.id), shards, jobs, run_command, merge_command);
}

}  // namespace irk
