#include "experiments/runner/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "experiments/runs/run_table.h"
#include "experiments/store/facts.h"
#include "experiments/study/series_walk.h"

namespace irk::store {
namespace {

constexpr std::size_t kShown = 10;

// The columns whose values the code alone determines.
std::vector<std::string> decidedColumns() {
  std::vector<std::string> columns{"outcome", "error", "error_u",          "error_v", "error_x",
                                   "error_z", "drift", "invariant_change", "mescd",   "scd"};
  Counters{}.forEach([&](const char* name, std::int64_t) { columns.emplace_back(name); });
  return columns;
}

/// Compares the rows of equal runs in several stores.
class Comparing {
 public:
  Comparing(const std::vector<const Store*>& stores, MergeReport& report) : stores_(stores), report_(report) {
    for (const auto* store : stores_) classes_.try_emplace(store, store->runs(), store->environments());
  }

  void compare(std::uint64_t key) {
    const Store* first = nullptr;
    bool duplicate = false;
    for (const auto* store : stores_) {
      if (!store->runs().find(key)) continue;
      if (first) {
        duplicate = true;
        compareRows(key, *first, *store);
      } else {
        first = store;
      }
    }
    if (!first) return;
    if (duplicate) ++report_.duplicate;
    const RowClass& of = classes_.at(first).of(*first->runs().find(key));
    ++rows_[of.library][of.name];
  }

  // The number of rows whose times are not of the timing class with most rows, among those of one library.
  std::size_t foreign() const {
    std::size_t foreign = 0;
    for (const auto& [library, classes] : rows_) {
      std::size_t all = 0, most = 0;
      for (const auto& [name, rows] : classes) {
        all += rows;
        most = std::max(most, rows);
      }
      foreign += all - most;
    }
    return foreign;
  }

 private:
  void compareRows(std::uint64_t key, const Store& first, const Store& second) {
    const TableRow one = first.runs().row(*first.runs().find(key)), other = second.runs().row(*second.runs().find(key));
    const auto text = [this](const TableRow& row, std::string_view column) { return textAt(names_, row, column); };
    if (text(one, "code") != text(other, "code")) return;
    const auto timeout = name(Outcome::kTimeout);
    if (text(one, "outcome") == timeout || text(other, "outcome") == timeout) return;
    std::string what;
    for (const auto& column : columns_) {
      if (text(one, column) == text(other, column)) continue;
      what += fmt::format("{}{} {} / {}", what.empty() ? "" : ", ", column, text(one, column), text(other, column));
    }
    if (what.empty()) return;
    report_.conflicts.push_back(
        {fmt::format("{} {} {} {}", one.front(), text(one, "scene"), text(one, "settings"), text(one, "method")),
         fmt::format("{} ({} / {})", what, first.folder().string(), second.folder().string())});
  }

  const std::vector<const Store*>& stores_;
  MergeReport& report_;
  const Table names_{{}, runColumns(), {}};
  const std::vector<std::string> columns_ = decidedColumns();
  std::map<const Store*, TimingClasses> classes_;
  std::map<std::string, std::map<std::string, std::size_t>> rows_;  // by library and timing class
};

void countNotOfStudy(const RunKeys& keys, const std::vector<const Store*>& stores, MergeReport& report) {
  std::unordered_set<std::uint64_t> others;
  for (const auto* store : stores) {
    store->runs().forEach([&](const Entry& entry) { others.insert(entry.key); });
  }
  keys.forEach([&](std::uint64_t key, const std::string&) { others.erase(key); });
  report.not_of_study = others.size();
}

}  // namespace

MergeReport reportOf(const Study& study, const RunKeys& keys, const std::vector<const Store*>& stores) {
  MergeReport report;
  Comparing comparing(stores, report);
  keys.forEach([&comparing](std::uint64_t key, const std::string&) { comparing.compare(key); });
  report.foreign = comparing.foreign();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Series& series = study.series[i];
    const auto its = keys[i];
    const auto state = stateOf(series, [&](std::size_t run) -> std::optional<RunFacts> {
      for (const auto* store : stores) {
        const auto entry = store->runs().find(its[run]);
        if (entry) return factsOf(store->runs(), *entry, series.end == SeriesEnd::kAsymptotic);
      }
      return {};
    });
    report.found += state.found.size();
    report.missing += state.missing.size() + state.unplanned;
    if (!state.missing.empty()) report.missing_series.push_back(i);
  }
  report.expected = report.found + report.missing;
  countNotOfStudy(keys, stores, report);
  return report;
}

std::map<std::string, std::string> studiesIn(const std::vector<std::unique_ptr<Store>>& stores) {
  const auto columns = runColumns();
  const auto at = static_cast<std::size_t>(std::find(columns.begin(), columns.end(), "study") - columns.begin());
  std::map<std::string, std::string> studies;
  for (const auto& store : stores) {
    store->runs().forEach(
        [&](const Entry& entry) { studies.try_emplace(store->runs().row(entry)[at], store->folder().string()); });
  }
  return studies;
}

std::string textOf(const MergeReport& report) {
  auto text = fmt::format(
      "expected {}, found {}, missing {}, duplicate {}, foreign (another processor, compiler or library) {}, not of "
      "the study {}, "
      "conflicts {}\n",
      report.expected, report.found, report.missing, report.duplicate, report.foreign, report.not_of_study,
      report.conflicts.size());
  for (std::size_t i = 0; i < std::min(kShown, report.conflicts.size()); ++i) {
    const auto& conflict = report.conflicts[i];
    text += fmt::format("  the same run with other numbers: {}: {}\n", conflict.run, conflict.what);
  }
  if (report.conflicts.size() > kShown) text += fmt::format("  and {} more\n", report.conflicts.size() - kShown);
  return text;
}

}  // namespace irk::store
