#include "experiments/analyses/costs/gaps.h"

#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "experiments/analyses/costs/robustness.h"
#include "experiments/audit/row_judgement.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/analysis.h"

namespace irk {
namespace {

struct SolverRun {
  std::string solver;
  audit::Judgement judgement;
  std::string outcome, detail;
};

// Scene, settings, tolerance (largest first).
using Problem = std::tuple<std::string, std::string, double>;

std::map<Problem, std::vector<SolverRun>> judgedByProblem(const RunFile& runs) {
  const Table& names = runs.names();
  const SolverNames solvers(runs);
  std::map<Problem, std::vector<SolverRun>> problems;
  runs.forEachRow([&](const TableRow& row) {
    const double tolerance = audit::toleranceOf(names, row);
    const std::string& outcome = textAt(names, row, "outcome");
    if (outcome == "refused" || std::isnan(tolerance)) return;
    problems[{textAt(names, row, "scene"), textAt(names, row, "settings"), -tolerance}].push_back(
        {solvers.of(row), audit::judgeRow(names, row), outcome, textAt(names, row, "detail")});
  });
  return problems;
}

}  // namespace

void writeGaps(const RunFile& runs, const std::filesystem::path& file) {
  using audit::Judgement;
  Table table{
      runs.names().head, {"scene", "settings", "tolerance", "solver", "judgement", "outcome", "detail", "right"}, {}};
  for (const auto& [problem, judged] : judgedByProblem(runs)) {
    std::string right;
    for (const auto& run : judged) {
      if (run.judgement == Judgement::kRight) right += (right.empty() ? "" : " ") + run.solver;
    }
    if (right.empty()) continue;
    const auto& [scene, settings, tolerance] = problem;
    for (const auto& run : judged) {
      if (run.judgement != Judgement::kFailed && run.judgement != Judgement::kWrong) continue;
      table.rows.push_back({scene, settings, numberText(-tolerance), run.solver,
                            std::string(audit::nameOf(run.judgement)), run.outcome, run.detail, right});
    }
  }
  writeTable(file, table);
}

Analysis gapsAnalysis() {
  return {.key = "gaps",
          .meaning = "the runs that are not right although another solver's run of the same problem is",
          .writes = "gaps.csv",
          .run = [](const AnalysisInput& in) { writeGaps(in.runs, in.folder / "gaps.csv"); }};
}

}  // namespace irk
