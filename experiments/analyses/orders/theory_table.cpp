#include "experiments/analyses/orders/theory_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "experiments/analyses/orders/row_theory.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/block_names.h"
#include "experiments/runs/run_table.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

// What distinguishes two curves of theory, apart from family and component.
constexpr std::string_view kNames[] = {"scene", "settings", "formulation", "multipliers"};

struct Family {
  TableRow row;  // of its last series, with the finest step
  std::optional<SystemKind> kind;
  bool one_kind = true;
};

struct Group {
  std::map<std::string, Family> families;
  Index least = kMaxStages, most = 1;
  std::string blocks;
};

void add(const Table& runs, const RunSeries& series, Group& group) {
  const TableRow& row = *series.rows.back();
  const auto stages = static_cast<Index>(numberAt(runs, row, "stages"));
  const auto& family = textAt(runs, row, "family");
  if (textAt(runs, row, "method") != fmt::format("{}_{}", family, stages)) return;  // of a user's file
  group.least = std::min(group.least, stages);
  group.most = std::max(group.most, stages);
  addBlocks(group.blocks, series.blocks);
  const auto kind = kindOf(runs, row, numberAt(runs, row, "h"));
  const auto [at, added] = group.families.try_emplace(family, Family{row, kind});
  at->second.one_kind = at->second.one_kind && (added || at->second.kind == kind);
}

TableRow withStages(const Table& runs, TableRow row, const std::string& family, Index stages) {
  row[runs.column("stages")] = std::to_string(stages);
  row[runs.column("method")] = fmt::format("{}_{}", family, stages);
  return row;
}

void append(const Table& runs, const Group& group, const FamilyEntry& entry, TableWriter& table) {
  const auto found = group.families.find(entry.id);
  if (found == group.families.end() || !found->second.one_kind) return;
  const auto& [row, kind, one_kind] = found->second;
  const Sizes n = sizesOf(runs, row);
  const std::string components =
      (n.nu > 0 ? "uv" : "") + std::string(n.nx > 0 ? "x" : "") + std::string(n.nz > 0 ? "z" : "");
  for (const char component : components) {
    // One stage more on both sides: a single measured number of stages would give a line of one point.
    const Index first = std::max(group.least - 1, entry.min_stages), last = std::min<Index>(group.most + 1, kMaxStages);
    for (Index s = first; s <= last; ++s) {
      const TableRow member = withStages(runs, row, entry.id, s);
      const Theory theory = theoryFor(runs, member, kind, component);
      if (std::isnan(theory.order)) continue;
      TableRow line;
      for (const auto name : kNames) line.push_back(textAt(runs, row, name));
      for (const auto* name : {"method", "family", "stages"}) line.push_back(textAt(runs, member, name));
      line.insert(line.end(), {std::string(1, component), "h", numberText(theory.order), theory.source, group.blocks});
      table.add(line);
    }
  }
}

}  // namespace

void writeTheory(const RunFile& runs, const std::filesystem::path& file) {
  const Table& names = runs.names();
  TableWriter table(file, names.head,
                    {"scene", "settings", "formulation", "multipliers", "method", "family", "stages", "component",
                     "power_of", "theory", "source", std::string(kBlockColumn)});
  std::map<std::vector<std::string>, std::size_t> places;
  std::vector<Group> groups;  // in the order of the runs
  runs.forEachSeries([&](const RunSeries& series) {
    const TableRow& row = *series.rows.back();
    if (!hasFixedStepsAt(names, row)) return;
    std::vector<std::string> name;
    for (const auto column : kNames) name.push_back(textAt(names, row, column));
    const auto [at, added] = places.try_emplace(name, groups.size());
    if (added) groups.emplace_back();
    add(names, series, groups[at->second]);
  });
  for (const Group& group : groups) {
    for (const FamilyEntry& entry : familyCatalogue()) append(names, group, entry, table);
  }
  table.close();
}

}  // namespace irk
