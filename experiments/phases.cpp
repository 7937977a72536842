#include "experiments/phases.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>

#include "experiments/clock.h"
#include "experiments/interrupt.h"
#include "experiments/newton_kernel.h"
#include "experiments/numbers.h"
#include "experiments/peers/catalogue.h"
#include "experiments/progress.h"
#include "experiments/run_table.h"

namespace irk {
namespace {

constexpr double kLeastTime = 2e-3;  // s, of one measurement: far above the clock's resolution
constexpr int kMeasurements = 3;

// The least time of one call: what disturbs a measurement only ever adds to it.
double secondsOf(const std::function<void()>& call) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMeasurements; ++i) {
    const double start = threadSeconds();
    double elapsed = 0;
    int calls = 0;
    while (elapsed < kLeastTime) {
      call();
      ++calls;
      elapsed = threadSeconds() - start;
    }
    least = std::min(least, elapsed / calls);
  }
  return least;
}

using Phases = std::array<double, 4>;  // residual, Jacobian, factorization, solve

Phases measure(NewtonKernel& kernel) {
  return {secondsOf([&] { kernel.residual(); }), secondsOf([&] { kernel.jacobian(); }),
          secondsOf([&] { kernel.factorize(); }), secondsOf([&] { kernel.solve(); })};
}

// How often the run did each. Residuals inside difference quotients belong to the Jacobian.
Phases counts(const Table& runs, const TableRow& run, const NewtonKernel& kernel) {
  const double jacobians = numberAt(runs, run, "jacobians");
  const double inside = static_cast<double>(kernel.residualsPerJacobian()) * jacobians;
  return {std::max(0.0, numberAt(runs, run, "residuals") - inside), jacobians,
          numberAt(runs, run, "factorizations"), numberAt(runs, run, "solves")};
}

TableRow phaseRow(const Table& runs, const TableRow& run, TableRow row, NewtonKernel& kernel) {
  const Phases each = measure(kernel), count = counts(runs, run, kernel);
  double sum = 0;
  for (std::size_t i = 0; i < each.size(); ++i) sum += each[i] * count[i];
  row.push_back(textAt(runs, run, "rtol"));
  row.push_back(std::to_string(kernel.unknowns()));
  for (const double seconds : each) row.push_back(numberText(seconds));
  for (std::size_t i = 0; i < each.size(); ++i) {
    row.push_back(numberText(each[i] * count[i] / sum));
  }
  row.push_back(numberText(sum / numberAt(runs, run, "cpu_s")));
  return row;
}

}  // namespace

Table phaseTable(const Study& study, const Table& runs, std::ostream& out) {
  Table table{runs.head, seriesColumns(runs), {}};
  table.columns.insert(
      table.columns.end(),
      {"rtol", "n", "residual_s", "jacobian_s", "factorization_s", "solve_s", "share_residual",
       "share_jacobian", "share_factorization", "share_solve", "covered"});
  const auto specs = specsByKey(study);
  Progress progress(out, study.id + " phases");
  for (const auto& row : runs.rows) progress.expect(textAt(runs, row, "settings"));
  for (const auto& series : seriesOf(runs)) {
    for (const auto* run : series.rows) {
      const auto spec = specs.find(run->front());
      const auto& kind = textAt(runs, *run, "settings");
      if (spec == specs.end() || !succeededAt(runs, *run) || interruptFlag() ||
          findPeer(spec->second->method)) {
        progress.skipped(kind);
        continue;
      }
      const double start = wallSeconds();
      const double h = spec->second->t_end / numberAt(runs, *run, "steps_accepted");
      NewtonKernel kernel(*spec->second, h);
      table.rows.push_back(phaseRow(runs, *run, series.name, kernel));
      progress.finished(kind, wallSeconds() - start);
    }
  }
  return table;
}

}  // namespace irk
