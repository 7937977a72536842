#include "experiments/report/publish/published_runs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <regex>

#include "experiments/analyses/results.h"
#include "experiments/base/failure.h"
#include "experiments/tables/build_info.h"
#include "experiments/tables/table_rows.h"

namespace irk::report {
namespace {

constexpr const char* kFromHead[] = {"code", "version", "commit", "date", "compiler", "flags", "libraries", "cpu"};

// A library's file without its folder, which tells nothing on another machine: `SUNDIALS 7.5.0,
// /opt/lib/libsundials.so`.
std::string withoutFolders(const std::string& text) {
  static const std::regex folder("(^|[ ,])/([^ ,;/]+/)*");
  return std::regex_replace(text, folder, "$1");
}

// `4c24df039347 (48 rows)`, as the store writes it: the code and its runs; empty if several programs made the rows.
struct MadeBy {
  std::string code, rows;
};
MadeBy madeBy(const std::string& text) {
  const auto open = text.find(" ("), close = text.find(" rows)");
  if (open == text.npos || close == text.npos || close < open || text.find(',') != text.npos) return {};
  return {text.substr(0, open), text.substr(open + 2, close - open - 2)};
}

// Studies with the same fault.
struct Faults {
  std::vector<std::string> missing, other_code, no_times;

  void refuse(const std::string& results, bool quick) const {
    std::string text;
    const auto add = [&](const std::vector<std::string>& studies, const std::string& what) {
      if (!studies.empty()) text += fmt::format("; {}: {}", what, fmt::join(studies, ", "));
    };
    const char* option = quick ? " --quick" : "";
    add(missing, fmt::format("missing (irk paper{0} and irk run audit{0} make them)", option));
    add(other_code,
        fmt::format("made by other code than this program's, {} (--stale remake makes them again)", buildInfo().code));
    add(no_times, "without times, which come from several processors");
    if (!text.empty()) throw Failure(fmt::format("'{}' cannot be published{}", results, text));
  }
};

}  // namespace

PublishedRuns publishedRuns(const ReportOptions& options, const std::vector<std::string>& studies) {
  PublishedRuns runs;
  runs.table.columns = {"study", "runs"};
  runs.table.columns.insert(runs.table.columns.end(), std::begin(kFromHead), std::end(kFromHead));
  Faults faults;
  std::string last_date;
  for (const auto& study : studies) {
    const auto file = options.results / study / "runs.csv";
    if (!std::filesystem::exists(file)) {
      faults.missing.push_back(study);
      continue;
    }
    const TableHead head = TableFile(file).names().head;
    const MadeBy made = madeBy(headEntry(head, "code"));
    if (made.code != buildInfo().code) faults.other_code.push_back(study);
    if (!refusedTimes(head).empty()) faults.no_times.push_back(study);
    if (const auto drift = timesDrift(file); !drift.empty()) runs.doubts.push_back(fmt::format("{}: {}", study, drift));
    TableRow row{study, made.rows, made.code};
    for (const auto* name : kFromHead) {
      if (std::string_view(name) != "code") row.push_back(withoutFolders(headEntry(head, name)));
    }
    const std::string date = headEntry(head, "date");
    last_date = std::max(last_date, date.substr(date.rfind(' ') + 1));
    runs.table.rows.push_back(std::move(row));
  }
  faults.refuse(options.results.string(), areQuick(options));
  runs.table.head = {{"version", std::string(buildInfo().version)},
                     {"code", std::string(buildInfo().code)},
                     {"commit", std::string(buildInfo().commit)},
                     {"date", last_date}};
  if (areQuick(options)) runs.table.head.emplace_back("quick", "small versions of the studies; preliminary");
  return runs;
}

}  // namespace irk::report
