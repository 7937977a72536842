#include "experiments/analyses/costs/ratios.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "experiments/analyses/costs/cost_at_error.h"
#include "experiments/base/median.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/block_names.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/analysis.h"
#include "experiments/study/study.h"

namespace irk {
namespace {

// What is solved, and by which method: no choices of a block. `integrator` follows from others.
constexpr std::string_view kNotCompared[] = {"scene", "settings", "method", "family", "stages", "integrator", "t_end"};

class Block {
 public:
  Block(const Table& runs, std::string name, const std::vector<RunSeries>& all)
      : runs_(runs), name_(std::move(name)), columns_(seriesColumns(runs)) {
    for (const auto& series : all) {
      if (hasBlock(series.blocks, name_)) series_.push_back(&series);
    }
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const auto differs = [&](const RunSeries* series) { return series->name[c] != series_.front()->name[c]; };
      const bool compared =
          std::find(std::begin(kNotCompared), std::end(kNotCompared), columns_[c]) == std::end(kNotCompared);
      if (compared && std::any_of(series_.begin(), series_.end(), differs)) choices_.push_back(c);
    }
  }

  void append(const std::vector<double>& targets, Table& ratios) const {
    for (const std::size_t choice : choices_) {
      const std::string& base = series_.front()->name[choice];
      for (const auto* series : series_) {
        if (series->name[choice] == base) continue;
        TableRow partner = series->name;
        partner[choice] = base;
        const auto at = std::find_if(series_.begin(), series_.end(), [&](auto* s) { return s->name == partner; });
        if (at != series_.end()) ratios.rows.push_back(row(choice, **at, *series, targets));
      }
    }
  }

 private:
  const std::string& cell(const RunSeries& series, std::string_view column) const {
    return textAt(runs_, *series.rows.front(), column);
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
        const double a = seriesCostAtError(runs_, base, cost, target),
                     b = seriesCostAtError(runs_, other, cost, target);
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

  const Table& runs_;
  std::string name_;
  std::vector<std::string> columns_;
  std::vector<const RunSeries*> series_;
  std::vector<std::size_t> choices_;  // the columns that vary
};

}  // namespace

Table ratioTable(const Table& runs, const std::vector<double>& targets) {
  Table ratios{runs.head, {"block", "scene", "settings", "method", "column", "value", "base", "others", "errors"}, {}};
  ratios.columns.insert(ratios.columns.end(), std::begin(kRatioCosts), std::end(kRatioCosts));
  ratios.columns.insert(ratios.columns.end(), {"lost", "won"});
  const auto series = seriesOf(runs);
  std::string blocks;
  for (const auto& one : series) addBlocks(blocks, one.blocks);
  for (std::size_t at = 0; at < blocks.size();) {
    const auto end = std::min(blocks.find(' ', at), blocks.size());
    Block(runs, blocks.substr(at, end - at), series).append(targets, ratios);
    at = end + 1;
  }
  return ratios;
}

Analysis ratiosAnalysis() {
  return {.id = "ratios",
          .key = "ratios",
          .meaning = "what each choice of a block costs, over its first choice, at the errors of `targets`",
          .reads = "runs.csv",
          .writes = "ratios.csv",
          .needs = "targets",
          .run = [](const AnalysisInput& in) -> std::vector<std::string> {
            writeTable(in.folder / "ratios.csv", ratioTable(in.runs, in.study.targets));
            return {};
          }};
}

}  // namespace irk
