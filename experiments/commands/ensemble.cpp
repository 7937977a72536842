#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <deque>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/base/number_text.h"
#include "experiments/base/failure.h"
#include "experiments/base/interrupt.h"
#include "experiments/commands/commands.h"
#include "experiments/ensembles/ensemble_run.h"
#include "experiments/tables/environment.h"
#include "experiments/tables/table.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

// The spec without the grid. Strategies that the user does not set are those of lanes.
RunSpec specOf(SolveOptions options) {
  options.settings.clear();
  if (!isGiven(options, "configuration")) options.fields.emplace_back("configuration", "embedded");
  if (!isGiven(options, "newton")) options.fields.emplace_back("newton", "simplified");
  return solveSpec(options);
}

Grid gridOf(const EnsembleArguments& arguments) {
  std::vector<GridAxis> parameters, starts;
  for (const std::string& text : arguments.run.settings) parameters.push_back(gridAxis("--set", text));
  for (const std::string& text : arguments.starts) starts.push_back(gridAxis("--start", text));
  return {std::move(parameters), std::move(starts)};
}

TableRow columnsOf(const EnsembleScene& scene) {
  TableRow columns;
  for (const GridAxis& axis : scene.grid().parameters()) columns.push_back(axis.name);
  for (const GridAxis& axis : scene.grid().starts()) columns.push_back(axis.name + "_start");
  columns.insert(columns.end(), {"outcome", "t"});
  columns.insert(columns.end(), scene.names().begin(), scene.names().end());
  Counters{}.forEach([&](const char* name, std::int64_t) { columns.emplace_back(name); });
  columns.emplace_back("detail");
  return columns;
}

TableRow cellsOf(const EnsembleScene& scene, std::size_t i, const Solution<double>& solution) {
  TableRow cells;
  for (const std::string_view value : scene.grid().at(i)) cells.emplace_back(value);
  const State<double>& state = solution.state;
  cells.emplace_back(name(solution.outcome));
  cells.push_back(numberText(state.t));
  const auto append = [&](const auto& part) {
    for (const double x : part) cells.push_back(numberText(x));
  };
  append(state.u);
  append(state.v);
  append(state.x);
  append(state.z());
  solution.counters.forEach([&](const char*, std::int64_t count) { cells.push_back(std::to_string(count)); });
  cells.push_back(solution.detail);
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
  MemberRows(const EnsembleScene& scene, const RunSpec& spec, const EnsembleArguments& arguments, std::ostream& out)
      : scene_(scene), columns_(columnsOf(scene)), json_(arguments.run.json), out_(out) {
    if (!arguments.run.out.empty()) {
      if (json_) throw Misuse("--out with --json: the file is CSV; leave one of them out");
      Table table{environmentHead("ensemble", arguments.jobs), columns_, {}};
      table.head.emplace_back("scene", spec.scene);
      table.head.emplace_back("method", spec.method);
      table.head.emplace_back("rtol", numberText(spec.options.tolerances.rtol));
      table.head.emplace_back("atol", numberText(spec.options.tolerances.atol));
      table.head.emplace_back("lanes", std::to_string(arguments.single ? 1 : kLanes));
      file_.emplace(arguments.run.out, table);
    } else if (!json_) {
      out_ << csvLine(columns_) << '\n';
    }
  }
  void add(std::size_t i, const Solution<double>& solution) {
    ++outcomes_[std::string(name(solution.outcome))];
    waiting_[i] = cellsOf(scene_, i, solution);
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

  const EnsembleScene& scene_;
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
  const double t_end = isGiven(arguments.run, "t_end") ? spec.t_end : std::numeric_limits<double>::quiet_NaN();
  const EnsembleScene scene(spec, gridOf(arguments), t_end);
  if (!arguments.single) static_cast<void>(LaneIntegrator(makeTableau<double>(spec.method), spec.options));
  if (!arguments.single) static_cast<void>(scene.lanes());
  MemberRows rows(scene, spec, arguments, streams.out);
  const InterruptScope interrupts;
  const double seconds = runEnsemble(scene, spec, {!arguments.single, threadCount(arguments.jobs), &interruptFlag()},
                                     [&](std::size_t i, const Solution<double>& solution) { rows.add(i, solution); });
  rows.finish();
  std::size_t all = 0;
  std::string text;
  for (const auto& [outcome, count] : rows.outcomes()) {
    all += count;
    text += fmt::format("{} {} {}", text.empty() ? ":" : ",", count, outcome);
  }
  fmt::print(streams.err, "{} of {} runs{}; {:.3g} s of CPU time\n", all, scene.grid().size(), text, seconds);
  if (interruptFlag()) return kInterruptedStatus;
  const auto succeeded = rows.outcomes().find(std::string(name(Outcome::kSuccess)));
  return succeeded != rows.outcomes().end() && succeeded->second == scene.grid().size() ? 0 : kFailedStatus;
}

}  // namespace irk
