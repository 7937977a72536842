#include "experiments/analyses/costs/ratios.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>

#include "experiments/analyses/costs/cost_at_error.h"
#include "experiments/base/median.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/block_names.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/analysis.h"
#include "experiments/study/study.h"

namespace irk {
namespace {

// The columns that are no choices of a block: the problem and the method. `integrator` follows from others.
constexpr std::string_view kNotCompared[] = {"scene", "settings", "method", "family", "stages", "integrator", "t_end"};

/// A block's series: memory holds their numbers, not their rows.
class Block {
 public:
  Block(const RunFile& runs, std::string name, std::vector<std::uint32_t> series)
      : runs_(runs), name_(std::move(name)), series_(std::move(series)), columns_(seriesColumns(runs.names())) {
    base_ = runs_[series_.front()].series.name;
    std::vector<bool> differs(columns_.size(), false);
    for (const auto i : series_) {
      const auto held = runs_[i];
      for (std::size_t c = 0; c < columns_.size(); ++c) differs[c] = differs[c] || held.series.name[c] != base_[c];
    }
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const bool compared =
          std::find(std::begin(kNotCompared), std::end(kNotCompared), columns_[c]) == std::end(kNotCompared);
      if (compared && differs[c]) choices_.push_back(c);
    }
  }

  void append(const std::vector<double>& targets, TableWriter& ratios) const {
    for (const std::size_t choice : choices_) {
      for (const auto i : series_) {
        const auto other = runs_[i];
        if (other.series.name[choice] == base_[choice]) continue;
        TableRow partner = other.series.name;
        partner[choice] = base_[choice];
        const auto at = runs_.find(partner);
        if (!at) continue;
        const auto base = runs_[*at];
        if (base.series.name == partner && hasBlock(base.series.blocks, name_)) {
          ratios.add(row(choice, base.series, other.series, targets));
        }
      }
    }
  }

 private:
  const std::string& cell(const RunSeries& series, std::string_view column) const {
    return textAt(runs_.names(), *series.rows.front(), column);
  }

  std::string others(std::size_t choice, const RunSeries& series) const {
    std::string text;
    for (const std::size_t c : choices_) {
      if (c != choice) text += fmt::format("{}{}={}", text.empty() ? "" : " ", columns_[c], series.name[c]);
    }
    return text;
  }

  TableRow row(std::size_t choice, const RunSeries& base, const RunSeries& other,
               const std::vector<double>& targets) const {
    TableRow row{name_,
                 cell(base, "scene"),
                 cell(base, "settings"),
                 cell(base, "method"),
                 columns_[choice],
                 other.name[choice],
                 base.name[choice],
                 others(choice, base)};
    int both = 0, lost = 0, won = 0;
    std::vector<std::string> medians;
    for (const char* cost : kRatioCosts) {
      std::vector<double> found;
      both = lost = won = 0;
      for (const double target : targets) {
        const double a = seriesCostAtError(runs_.names(), base, cost, target),
                     b = seriesCostAtError(runs_.names(), other, cost, target);
        lost += !std::isnan(a) && std::isnan(b) ? 1 : 0;
        won += std::isnan(a) && !std::isnan(b) ? 1 : 0;
        if (std::isnan(a) || std::isnan(b)) continue;
        ++both;
        found.push_back(b / a);
      }
      medians.push_back(numberText(median(std::move(found))));
    }
    row.push_back(std::to_string(both));
    row.insert(row.end(), medians.begin(), medians.end());
    row.insert(row.end(), {std::to_string(lost), std::to_string(won)});
    return row;
  }

  const RunFile& runs_;
  std::string name_;
  std::vector<std::uint32_t> series_;
  std::vector<std::string> columns_;
  TableRow base_;                     // the name of the block's first series
  std::vector<std::size_t> choices_;  // the columns that vary
};

/// The series of each block, blocks in the order of their first series.
std::vector<std::pair<std::string, std::vector<std::uint32_t>>> blocksOf(const RunFile& runs) {
  std::vector<std::pair<std::string, std::vector<std::uint32_t>>> blocks;
  std::uint32_t number = 0;
  runs.forEachSeries([&](const RunSeries& series) {
    std::istringstream names(series.blocks);
    for (std::string name; names >> name;) {
      auto at = std::find_if(blocks.begin(), blocks.end(), [&](const auto& block) { return block.first == name; });
      if (at == blocks.end()) at = blocks.insert(at, {name, {}});
      at->second.push_back(number);
    }
    ++number;
  });
  return blocks;
}

}  // namespace

void writeRatios(const RunFile& runs, const std::vector<double>& targets, const std::filesystem::path& file) {
  std::vector<std::string> columns{"block", "scene", "settings", "method", "column",
                                   "value", "base",  "others",   "errors"};
  columns.insert(columns.end(), std::begin(kRatioCosts), std::end(kRatioCosts));
  columns.insert(columns.end(), {"lost", "won"});
  TableWriter ratios(file, runs.names().head, columns);
  for (auto& [name, series] : blocksOf(runs)) Block(runs, name, std::move(series)).append(targets, ratios);
  ratios.close();
}

Analysis ratiosAnalysis() {
  return {.key = "ratios",
          .meaning = "what each choice of a block costs, over its first choice, at the errors of `targets`",
          .writes = "ratios.csv",
          .needs = "targets",
          .run = [](const AnalysisInput& in) { writeRatios(in.runs, in.study.targets, in.folder / "ratios.csv"); }};
}

}  // namespace irk
