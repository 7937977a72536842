#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/number_text.h"
#include "experiments/base/failure.h"
#include "experiments/base/interrupt.h"
#include "experiments/commands/commands.h"
#include "experiments/ensembles/ensemble_run.h"
#include "experiments/runs/fields.h"
#include "experiments/tables/environment.h"
#include "experiments/tables/table.h"

namespace irk {
namespace {

// The spec without the grid. What the user does not choose is made for many runs: the strategies that take the least
// time, and no error bars, which take another integration each.
RunSpec specOf(SolveOptions options) {
  options.settings.clear();
  RunSpec defaults;
  if (!isGiven(options, "configuration")) findField("configuration").set(defaults, "embedded");
  RunSpec spec = solveSpec(options, defaults);
  if (!isGiven(options, axisName<ErrorBarUse>())) spec.error_bar = ErrorBarUse::kNone;
  if (!isGiven(options, "t_end")) spec.t_end = std::numeric_limits<double>::quiet_NaN();
  return spec;
}

Grid gridOf(const EnsembleArguments& arguments) {
  std::vector<GridAxis> parameters, starts;
  for (const std::string& text : arguments.run.settings) parameters.push_back(gridAxis("--set", text));
  for (const std::string& text : arguments.starts) starts.push_back(gridAxis("--start", text));
  return {std::move(parameters), std::move(starts)};
}

TableRow columnsOf(const Ensemble& ensemble, bool bars) {
  TableRow columns;
  for (const GridAxis& axis : ensemble.grid().parameters()) columns.push_back(axis.name);
  for (const GridAxis& axis : ensemble.grid().starts()) columns.push_back(axis.name + "_start");
  columns.insert(columns.end(), {"outcome", "t"});
  columns.insert(columns.end(), ensemble.names().begin(), ensemble.names().end());
  Counters{}.forEach([&](const char* name, std::int64_t) { columns.emplace_back(name); });
  if (bars) columns.emplace_back("error_bar_tolerances");
  columns.emplace_back("detail");
  return columns;
}

// The final state with the digits of its scalar; `nan` for each of the components that a refused run does not have.
TableRow stateOf(const RunRecord& record, std::size_t components) {
  if (!record.digits.empty()) return record.digits;
  TableRow state;
  for (const Vec<double>* part : {&record.u, &record.v, &record.x, &record.z}) {
    for (const double y : *part) state.push_back(numberText(y));
  }
  state.resize(components, "nan");
  return state;
}

TableRow cellsOf(const Ensemble& ensemble, std::size_t i, bool bars, const RunRecord& record) {
  TableRow cells;
  for (const std::string_view value : ensemble.grid().at(i)) cells.emplace_back(value);
  cells.push_back(record.outcome);
  cells.push_back(numberText(record.t));
  const TableRow state = stateOf(record, ensemble.names().size());
  cells.insert(cells.end(), state.begin(), state.end());
  record.counters.forEach([&](const char*, std::int64_t count) { cells.push_back(std::to_string(count)); });
  const RunErrorBar& bar = record.error_bar;
  if (bars) cells.push_back(numberText(bar.tolerances));
  cells.push_back(record.detail + (record.detail.empty() || bar.told().empty() ? "" : "; ") + bar.told());
  return cells;
}

// The row as a JSON object: numbers as numbers, other cells as text.
std::string jsonLine(const TableRow& columns, const TableRow& cells) {
  nlohmann::ordered_json line;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const bool number = nlohmann::json::accept(cells[k]);
    line[columns[k]] = number ? nlohmann::ordered_json::parse(cells[k]) : nlohmann::ordered_json(cells[k]);
  }
  return line.dump();
}

/// Writes the rows in the order of the grid, each as soon as those before it are known.
class MemberRows {
 public:
  MemberRows(const Ensemble& ensemble, const RunSpec& spec, const EnsembleArguments& arguments, std::ostream& out)
      : ensemble_(ensemble),
        bars_(spec.error_bar != ErrorBarUse::kNone),
        columns_(columnsOf(ensemble, bars_)),
        json_(arguments.run.json),
        out_(out) {
    if (!arguments.run.out.empty()) {
      if (json_) throw Misuse("--out with --json: the file is CSV; leave one of them out");
      Table table{environmentHead("ensemble", arguments.jobs), columns_, {}};
      table.head.emplace_back("scene", spec.scene);
      table.head.emplace_back("method", spec.method);
      table.head.emplace_back("rtol", numberText(spec.options.tolerances.rtol));
      table.head.emplace_back("atol", numberText(spec.options.tolerances.atol));
      file_.emplace(arguments.run.out, table);
    } else if (!json_) {
      out_ << csvLine(columns_) << '\n';
    }
  }
  void add(std::size_t i, const RunRecord& record) {
    ++outcomes_[record.outcome];
    waiting_[i] = cellsOf(ensemble_, i, bars_, record);
    for (auto row = waiting_.find(next_); row != waiting_.end(); row = waiting_.find(++next_)) {
      write(row->second);
      waiting_.erase(row);
    }
  }
  /// Writes the remaining rows: after an interrupt some rows are missing, and those behind them are written as well.
  void finish() {
    for (const auto& [i, row] : waiting_) write(row);
    out_.flush();
  }
  const std::map<std::string, std::size_t>& outcomes() const { return outcomes_; }

 private:
  void write(const TableRow& row) {
    if (file_) return file_->append(row);
    out_ << (json_ ? jsonLine(columns_, row) : csvLine(row)) << '\n';
  }

  const Ensemble& ensemble_;
  bool bars_;
  TableRow columns_;
  bool json_;
  std::ostream& out_;
  std::optional<RowWriter> file_;
  std::map<std::size_t, TableRow> waiting_;
  std::size_t next_ = 0;
  std::map<std::string, std::size_t> outcomes_;
};

}  // namespace

int ensembleCommand(const EnsembleArguments& arguments, Streams streams) {
  const RunSpec spec = specOf(arguments.run);
  const Ensemble ensemble(spec, gridOf(arguments));
  MemberRows rows(ensemble, spec, arguments, streams.out);
  const InterruptScope interrupts;
  const double seconds = runEnsemble(ensemble, threadCount(arguments.jobs), interruptFlag(),
                                     [&](std::size_t i, const RunRecord& record) { rows.add(i, record); });
  rows.finish();
  std::size_t all = 0;
  std::string text;
  for (const auto& [outcome, count] : rows.outcomes()) {
    all += count;
    text += fmt::format("{} {} {}", text.empty() ? ":" : ",", count, outcome);
  }
  fmt::print(streams.err, "{} of {} runs{}; {:.3g} s of CPU time\n", all, ensemble.grid().size(), text, seconds);
  if (interruptFlag()) return kInterruptedStatus;
  const auto succeeded = rows.outcomes().find(std::string(name(Outcome::kSuccess)));
  return succeeded != rows.outcomes().end() && succeeded->second == ensemble.grid().size() ? 0 : kFailedStatus;
}

}  // namespace irk
