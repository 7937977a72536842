#include "experiments/runner/cores/processors.h"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <string>
#include <utility>

#include "experiments/base/failure.h"

namespace irk::cores {
namespace {

// The first line; empty if there is none.
std::string lineOf(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

}  // namespace

std::vector<int> physicalCores(const std::vector<int>& allowed, const std::filesystem::path& system) {
  std::set<std::string> cores;                                     // the processors of each, as text
  std::vector<std::pair<std::string, std::vector<int>>> by_cache;  // the processors that share it, and those taken
  for (const int processor : allowed) {
    const auto folder = system / fmt::format("cpu{}", processor);
    const auto core = lineOf(folder / "topology/thread_siblings_list");
    if (!core.empty() && !cores.insert(core).second) continue;
    const auto cache = lineOf(folder / "cache/index3/shared_cpu_list");
    auto its = std::ranges::find(by_cache, cache, &std::pair<std::string, std::vector<int>>::first);
    if (its == by_cache.end()) its = by_cache.insert(its, {cache, {}});
    its->second.push_back(processor);
  }
  std::vector<int> taken;
  for (std::size_t turn = 0, before = 0; turn == 0 || taken.size() > before; ++turn) {
    before = taken.size();
    for (const auto& [cache, processors] : by_cache) {
      if (turn < processors.size()) taken.push_back(processors[turn]);
    }
  }
  return taken;
}

std::vector<int> physicalCores() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return {sched_getcpu()};  // more than CPU_SETSIZE of them
  std::vector<int> allowed;
  for (int processor = 0; processor < CPU_SETSIZE; ++processor) {
    if (CPU_ISSET(static_cast<std::size_t>(processor), &set)) allowed.push_back(processor);
  }
  return physicalCores(allowed, "/sys/devices/system/cpu");
}

void pinTo(int processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(processor), &set);
  if (sched_setaffinity(0, sizeof set, &set) != 0) {
    throw Failure(fmt::format("processor {} cannot be used: {}", processor, std::strerror(errno)));
  }
}

}  // namespace irk::cores
