#include "experiments/audit/row_judgement.h"

#include <algorithm>
#include <cmath>

#include "experiments/runs/run_table.h"

namespace irk::audit {

double toleranceOf(const Table& runs, const TableRow& row) {
  if (runs.hasColumn("control") && hasFixedStepsAt(runs, row)) return std::nan("");
  return std::max(numberAt(runs, row, "rtol"), numberAt(runs, row, "atol"));
}

Judgement judgeRow(const Table& runs, const TableRow& row) {
  Evidence evidence{.success = succeededAt(runs, row), .tolerance = toleranceOf(runs, row)};
  if (std::isnan(evidence.tolerance)) return evidence.success ? Judgement::kUnjudged : Judgement::kFailed;
  for (const auto* column : {"error_u", "error_v", "error_x"}) {
    evidence.error = std::fmax(evidence.error, numberAt(runs, row, column));
  }
  const double accuracy = runs.hasColumn("reference_accuracy") ? numberAt(runs, row, "reference_accuracy") : 0;
  evidence.accuracy = std::isnan(accuracy) ? 0 : accuracy;
  evidence.kappa = 1;
  return judge(evidence);
}

}  // namespace irk::audit
