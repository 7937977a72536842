#include "experiments/analyses/costs/profile.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "experiments/analyses/costs/cost_at_error.h"
#include "experiments/analyses/results.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/analysis.h"
#include "irk/collections.h"

namespace irk {
namespace {

constexpr double kEnd = 1e6;                           // where the curves end
constexpr std::uint64_t kSpread = 0x9e3779b97f4a7c15;  // odd, with bits at random places

/// A cost that counts.
struct Given {
  std::uint64_t problem;  // hash of scene and settings
  double time;            // infinity if the solver does not solve it
  std::uint32_t solver, scene, target;
};

/// Numbers for texts, in their order of appearance; visited in alphabetical order.
using Ids = std::map<std::string, std::uint32_t>;

std::uint32_t idOf(const std::string& text, Ids& ids) {
  return ids.try_emplace(text, static_cast<std::uint32_t>(ids.size())).first->second;
}

struct AllCosts {
  Ids solvers, scenes, targets;
  std::vector<Given> given;
};

/// A time of one curve.
struct Time {
  std::uint64_t problem;
  double seconds;
  std::uint32_t solver;
};

// Keeps the least time of each problem, of each solver if they are told apart.
template <class Key>
void keepLeast(std::vector<Time>& times, Key key) {
  std::sort(times.begin(), times.end(), [&](const Time& a, const Time& b) {
    return std::tuple(key(a), a.problem, a.seconds) < std::tuple(key(b), b.problem, b.seconds);
  });
  const auto same = [&](const Time& a, const Time& b) { return key(a) == key(b) && a.problem == b.problem; };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
}

void appendProfile(const TableRow& start, std::vector<Time> times, const Ids& solvers, TableWriter& table) {
  keepLeast(times, [](const Time& time) { return time.solver; });
  std::vector<Time> best;  // of every problem that some solver solves
  std::copy_if(times.begin(), times.end(), std::back_inserter(best),
               [](const Time& time) { return !std::isinf(time.seconds); });
  keepLeast(best, [](const Time&) { return 0; });
  const std::string problems = std::to_string(best.size());
  for (const auto& [solver, id] : solvers) {
    std::vector<double> ratios;  // time over best time, of the problems that it solves
    std::size_t given = 0;
    const auto first = std::lower_bound(times.begin(), times.end(), id,
                                        [](const Time& time, std::uint32_t its) { return time.solver < its; });
    for (auto time = first; time != times.end() && time->solver == id; ++time) {
      const auto solved =
          std::lower_bound(best.begin(), best.end(), time->problem,
                           [](const Time& its, std::uint64_t problem) { return its.problem < problem; });
      if (solved == best.end() || solved->problem != time->problem) continue;
      ++given;
      if (!std::isinf(time->seconds)) ratios.push_back(time->seconds / solved->seconds);
    }
    if (given == 0) continue;
    std::sort(ratios.begin(), ratios.end());
    const auto addRow = [&, &name = solver](double ratio, std::size_t count) {
      const double fraction = static_cast<double>(count) / static_cast<double>(given);
      TableRow row = start;
      row.insert(row.end(), {name, numberText(ratio), numberText(fraction), std::to_string(given), problems});
      table.add(row);
    };
    if (ratios.empty()) addRow(1, 0);
    for (std::size_t i = 0; i < ratios.size(); ++i) addRow(ratios[i], i + 1);
    addRow(kEnd, ratios.size());
  }
}

AllCosts readCosts(TableFile& file) {
  AllCosts all;
  const Table& costs = file.names();
  while (const auto next = file.next()) {
    const TableRow& row = *next;
    if (!isComparable(costs, row)) continue;
    const double cost = numberAt(costs, row, "cpu_s");
    const auto& scene = textAt(costs, row, "scene");
    all.given.push_back({fnv1a(scene + " " + textAt(costs, row, "settings")),
                         std::isnan(cost) ? std::numeric_limits<double>::infinity() : cost,
                         idOf(textAt(costs, row, "integrator"), all.solvers), idOf(scene, all.scenes),
                         idOf(textAt(costs, row, "target_error"), all.targets)});
  }
  return all;
}

// The scenes of each collection, by their ids.
std::map<std::string, std::set<std::uint32_t>> collectionsIn(const Ids& scenes) {
  std::map<std::string, std::set<std::uint32_t>> collections;
  for (const auto& [scene, id] : scenes) {
    for (const auto& collection : collectionsOf(scene)) collections[collection].insert(id);
    collections["all"].insert(id);
  }
  return collections;
}

}  // namespace

void writeProfile(const std::filesystem::path& costs, const std::filesystem::path& file) {
  TableFile read(costs);
  const AllCosts all = readCosts(read);
  TableWriter table(file, read.names().head,
                    {"collection", "target_error", "integrator", "ratio", "fraction", "given", "problems"});
  std::map<std::string, std::optional<std::uint32_t>> targets{{"all", std::nullopt}};
  targets.insert(all.targets.begin(), all.targets.end());
  for (const auto& [collection, scenes] : collectionsIn(all.scenes)) {
    for (const auto& [name, target] : targets) {
      std::vector<Time> times;
      for (const auto& given : all.given) {
        if (!scenes.contains(given.scene) || (target && given.target != *target)) continue;
        // Over all targets, each is a problem of its own.
        const auto problem = target ? given.problem : given.problem ^ ((given.target + 1) * kSpread);
        times.push_back({problem, given.time, given.solver});
      }
      if (!times.empty()) appendProfile({collection, name}, std::move(times), all.solvers, table);
    }
  }
  table.close();
}

Analysis profileAnalysis() {
  return {.id = "profile",
          .key = "profile",
          .meaning = "performance profiles of integrators at the errors of `targets`",
          .reads = "cpu_at_error.csv",
          .writes = "profile.csv",
          .needs = "targets",
          .run = [](const AnalysisInput& in) {
            // Without times no profile is written, and an older one must not remain beside these runs.
            if (refusedTimes(in.runs.names().head).empty()) {
              writeProfile(in.folder / "cpu_at_error.csv", in.folder / "profile.csv");
            } else {
              std::filesystem::remove(in.folder / "profile.csv");
            }
          }};
}

}  // namespace irk
