#include "experiments/report/explorer/explorer_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <unordered_map>

#include "experiments/analyses/results.h"
#include "experiments/audit/row_judgement.h"
#include "experiments/base/html.h"
#include "experiments/base/numbers.h"
#include "experiments/report/own_figures.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/run_command.h"
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

// Safe inside <script> (no '<') and against placeholders (no '@').
std::string safeText(const Json& json) {
  std::string safe = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  replacePlaceholder(safe, "<", "\\u003c");
  replacePlaceholder(safe, "@", "\\u0040");
  return safe;
}

// Four digits are more than a diagram shows; null for unknown.
Json rounded(double x) {
  if (!std::isfinite(x)) return nullptr;
  return cellNumber(fmt::format("{:.4g}", x));
}

/// A JSON array.
class Array {
 public:
  std::size_t size() const { return size_; }
  void append(const Json& json) {
    text_.append(size_++ == 0 ? "" : ",");
    text_.append(safeText(json));
  }
  void fillUpTo(std::size_t size) {
    while (size_ < size) append(nullptr);
  }
  void write(std::ostream& out) const { out << '[' << text_ << ']'; }

 private:
  std::string text_;
  std::size_t size_ = 0;
};

using Object = std::map<std::string, Array>;

void write(const Object& object, std::ostream& out) {
  const char* before = "{";
  for (const auto& [name, array] : object) {
    out << before << safeText(name) << ':';
    array.write(out);
    before = ",";
  }
  out << (object.empty() ? "{}" : "}");
}

std::string titleOf(const std::filesystem::path& results, const std::string& study) {
  const auto own = ownStudies(results);
  if (std::find(own.begin(), own.end(), study) != own.end()) return ownTitle(results, study);
  return loadStudy(study, StudyVariant::kQuick).title;
}

class Collector {
 public:
  // Times of several processors are left out.
  void add(const std::string& study, const RunFile& table) {
    const bool times_refused = !refusedTimes(table.names().head).empty();
    const auto& columns = table.names().columns;
    quantities_.clear();
    digits_.clear();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const bool refused = times_refused && columns[c].starts_with("cpu_");
      if (isQuantity(columns[c]) && !refused) quantities_.push_back(c);
      if (isDigits(columns[c])) digits_.push_back(c);
    }
    table.forEachSeries([&](const RunSeries& of) { addSeries(study, table.names(), of); });
  }

  void write(const Json& studies, std::ostream& out) {
    for (auto& [name, values] : runs_) values.fillUpTo(count_);
    out << "{\"runs\":";
    irk::write(runs_, out);
    out << ",\"series\":";
    series_.write(out);
    out << ",\"studies\":" << safeText(studies) << ",\"words\":";
    irk::write(words_, out);
    out << '}';
  }

 private:
  void addSeries(const std::string& study, const Table& table, const RunSeries& of) {
    const TableRow& first = *of.rows.front();
    const auto text = [&](const char* column) { return textAt(table, first, column); };
    const auto command = seriesCommand(table, first);
    Json options = Json::array();
    for (const auto& [name, value] : command.options) options.push_back({name, value});
    const bool peer = text("integrator") == text("method");
    series_.append({{"study", study},
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
    put("series", series_.size() - 1);
    put("outcome", word("outcome", textAt(table, row, "outcome")));
    put("detail", word("detail", textAt(table, row, "detail")));
    put("swept", word("swept", sweptOptions(table, row)));
    put("tolerance", rounded(audit::toleranceOf(table, row)));
    put("wrong", audit::judgeRow(table, row) == audit::Judgement::kWrong ? 1 : 0);
    for (const auto c : quantities_) put(table.columns[c], rounded(cellNumber(row[c])));
    // Digits as the errors that they count, which are drawn over the same logarithmic axes as all others.
    for (const auto c : digits_) put("error_" + table.columns[c], rounded(std::pow(10, -cellNumber(row[c]))));
    ++count_;
  }

  // A study may lack columns of those before it, and the reverse.
  void put(const std::string& column, const Json& value) {
    auto& values = runs_[column];
    values.fillUpTo(count_);
    values.append(value);
  }

  // The number of a text; texts are told apart by their hashes.
  std::size_t word(const std::string& column, const std::string& text) {
    auto& known = numbers_[column];
    const auto [at, added] = known.try_emplace(fnv1a(text), known.size());
    if (added) words_[column].append(text);
    return at->second;
  }

  Array series_;
  Object runs_, words_;
  std::size_t count_ = 0;                         // of runs
  std::vector<std::size_t> quantities_, digits_;  // columns of the present study
  std::map<std::string, std::unordered_map<std::uint64_t, std::size_t>> numbers_;
};

}  // namespace

std::vector<std::string> exploredStudies(const std::filesystem::path& results) {
  std::vector<std::string> studies(std::begin(kStudies), std::end(kStudies));
  for (auto& study : ownStudies(results)) studies.push_back(std::move(study));
  std::erase_if(studies, [&](const auto& study) { return !std::filesystem::exists(results / study / "runs.csv"); });
  return studies;
}

void writeExplorerData(const std::filesystem::path& results, std::ostream& out) {
  Collector collected;
  Json studies = Json::array();
  for (const auto& study : exploredStudies(results)) {
    const RunFile runs(results / study / "runs.csv");
    if (runs.rows() == 0) continue;
    studies.push_back(
        {{"id", study}, {"title", titleOf(results, study)}, {"no_times", refusedTimes(runs.names().head)}});
    collected.add(study, runs);
  }
  collected.write(studies, out);
}

}  // namespace irk
