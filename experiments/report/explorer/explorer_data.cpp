#include "experiments/report/explorer/explorer_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

#include "experiments/analyses/results.h"
#include "experiments/audit/row_judgement.h"
#include "experiments/base/numbers.h"
#include "experiments/report/explorer/run_command.h"
#include "experiments/report/own_figures.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/study.h"
#include "experiments/study/study_reader.h"
#include "irk/statistics.h"

namespace irk {
namespace {

using Json = nlohmann::json;

// Of the built-in studies those that compare errors with costs.
constexpr std::string_view kStudies[] = {"work_precision", "robustness", "peers",      "beam",
                                         "heat",           "families",   "cpu_time",   "discontinuity",
                                         "control",        "jacobian",   "newton_rule"};

// Columns of runs.csv that are drawn: errors (whatever the table has), counters, times.
bool isQuantity(std::string_view column) {
  bool counter = false;
  Counters{}.forEach([&](const char* name, std::int64_t) { counter = counter || column == name; });
  return counter || column.starts_with("error") || column == "drift" || column == "invariant_change" || column == "h" ||
         column == "cpu_s" || column == "cpu_median_s";
}

bool isDigits(std::string_view column) { return column == "mescd" || column == "scd"; }

// Four digits are more than a diagram shows; null for unknown.
Json rounded(double x) {
  if (!std::isfinite(x)) return nullptr;
  return cellNumber(fmt::format("{:.4g}", x));
}

std::string titleOf(const std::filesystem::path& results, const std::string& study) {
  const auto own = ownStudies(results);
  if (std::find(own.begin(), own.end(), study) != own.end()) return keptFigures(results, study).title;
  return loadStudy(study, StudyVariant::kQuick).title;
}

class Collector {
 public:
  // Times of several processors are left out.
  void add(const std::string& study, const Table& table) {
    times_refused_ = !refusedTimes(table.head).empty();
    for (const auto& of : seriesOf(table)) addSeries(study, table, of);
  }

  Json series = Json::array(), words = Json::object(), runs = Json::object();

 private:
  void addSeries(const std::string& study, const Table& table, const RunSeries& of) {
    const TableRow& first = *of.rows.front();
    const auto text = [&](const char* column) { return textAt(table, first, column); };
    const auto command = seriesCommand(table, first);
    Json options = Json::array();
    for (const auto& [name, value] : command.options) options.push_back({name, value});
    const bool peer = text("integrator") == text("method");
    series.push_back({{"study", study},
                      {"scene", text("scene")},
                      {"settings", text("settings")},
                      {"t_end", rounded(numberAt(table, first, "t_end"))},
                      {"method", text("method")},
                      {"family", peer ? text("method") : text("family")},
                      {"stages", numberAt(table, first, "stages")},
                      {"peer", peer},
                      {"integrator", text("integrator")},
                      {"options", options},
                      {"command", command.text}});
    for (const auto* row : of.rows) addRun(table, *row);
  }

  void addRun(const Table& table, const TableRow& row) {
    put("series", series.size() - 1);
    put("outcome", word("outcome", textAt(table, row, "outcome")));
    put("detail", word("detail", textAt(table, row, "detail")));
    put("swept", word("swept", sweptOptions(table, row)));
    put("tolerance", rounded(audit::toleranceOf(table, row)));
    put("wrong", audit::judgeRow(table, row) == audit::Judgement::kWrong ? 1 : 0);
    for (const auto& column : table.columns) {
      const bool refused = times_refused_ && column.starts_with("cpu_");
      if (isQuantity(column) && !refused) put(column, rounded(numberAt(table, row, column)));
      // Digits as the errors that they count, which are drawn over the same logarithmic axes as all others.
      if (isDigits(column)) put("error_" + column, rounded(std::pow(10, -numberAt(table, row, column))));
    }
    ++count_;
    for (auto& [name, values] : runs.items()) {
      while (values.size() < count_) values.push_back(nullptr);  // a column that this study does not have
    }
  }

  void put(const std::string& column, Json value) {
    auto& values = runs[column];
    while (values.size() < count_) values.push_back(nullptr);
    values.push_back(std::move(value));
  }

  std::size_t word(const std::string& column, const std::string& text) {
    auto& known = numbers_[column];
    const auto [at, added] = known.try_emplace(text, known.size());
    if (added) words[column].push_back(text);
    return at->second;
  }

  std::size_t count_ = 0;
  bool times_refused_ = false;
  std::map<std::string, std::map<std::string, std::size_t>> numbers_;
};

}  // namespace

std::vector<std::string> exploredStudies(const std::filesystem::path& results) {
  std::vector<std::string> studies(std::begin(kStudies), std::end(kStudies));
  for (auto& study : ownStudies(results)) studies.push_back(std::move(study));
  std::erase_if(studies, [&](const auto& study) { return !std::filesystem::exists(results / study / "runs.csv"); });
  return studies;
}

std::string explorerData(const std::filesystem::path& results) {
  Collector collected;
  Json studies = Json::array();
  for (const auto& study : exploredStudies(results)) {
    const Table runs = readTable(results / study / "runs.csv");
    if (runs.rows.empty()) continue;
    studies.push_back({{"id", study}, {"title", titleOf(results, study)}, {"no_times", refusedTimes(runs.head)}});
    collected.add(study, runs);
  }
  const Json data{
      {"studies", studies}, {"series", collected.series}, {"words", collected.words}, {"runs", collected.runs}};
  std::string safe;
  for (const char c : data.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') {
      safe += "\\u003c";
    } else if (c == '@') {
      safe += "\\u0040";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace irk
