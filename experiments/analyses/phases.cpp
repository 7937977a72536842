#include "experiments/analyses/phases.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>

#include "experiments/analyses/newton_kernel.h"
#include "experiments/base/clock.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/numbers.h"
#include "experiments/base/progress.h"
#include "experiments/runs/run.h"
#include "experiments/runs/run_table.h"
#include "experiments/runs/setup.h"
#include "experiments/study/analysis.h"

namespace irk {
namespace {

// Seconds per batch. Reading the thread clock is a system call of about half a microsecond.
constexpr double kMinBatch = 2e-3;
// Each round measures the run and all of its parts, so that a machine that is slow for a while does not slow every
// measurement of one of them. As long as the parts do not cover the run, further rounds follow for up to
// kMaxSeconds: disturbances only add time, and more to a whole run than to its parts, whose code and data stay in
// the cache.
constexpr int kRounds = 5;
constexpr double kMaxSeconds = 3;
constexpr double kMinCovered = 0.9, kMaxCovered = 1.1;

constexpr std::array<std::string_view, 9> kParts = {
    "residual",     "jacobian", "factorization", "solve", "filter_factorization",
    "filter_solve", "update",   "step",          "start"};
using Parts = std::array<double, kParts.size()>;

bool covers(double covered) { return covered >= kMinCovered && covered <= kMaxCovered; }

// Seconds per call: the mean over a batch so long that reading the clock takes less than 1 % of it.
double batchSeconds(const std::function<void()>& call) {
  for (std::int64_t calls = 1;; calls *= 2) {
    const double start = threadSeconds();
    for (std::int64_t i = 0; i < calls; ++i) call();
    const double elapsed = threadSeconds() - start;
    if (elapsed >= kMinBatch) return elapsed / static_cast<double>(calls);
  }
}

/// Measures one run and its parts.
class PhaseMeasurement {
 public:
  PhaseMeasurement(const RunSpec& spec, double h)
      : kernel_(spec, h), run_(prepare(unlimited(spec))), start_(prepare(startOf(spec))) {
    const RunRecord record = run_->execute({});
    counters_ = record.counters;
    start_counters_ = start_->execute({}).counters;
    kernel_.moveTo(endOf(spec, record));
    kernel_.factorize();
  }

  Index unknowns() const { return kernel_.unknowns(); }
  double runSeconds() const { return run_s_; }
  /// Seconds of each part.
  Parts each() const {
    // Timed alone, a call begins before the last one has ended; in an iteration it waits for the part before it. The
    // parts of an iteration are therefore scaled to the time of an iteration.
    Parts parts = each_;
    auto& [residual, jacobian, factorization, solve, filter_factorization, filter_solve, update, step, start] = parts;
    const double alone = static_cast<double>(kernel_.stages()) * residual + solve + update;
    const double stretch = std::max(iteration_s_ / alone, 1.0);
    for (double* part : {&residual, &solve, &update}) *part *= stretch;
    const double rest = attempts_ ? attempts_s_ - partsOf(*attempts_, parts) : 0;
    step += std::max(rest / 2, 0.0);
    return parts;
  }

  /// The total time of each part in the run.
  Parts total() const {
    Parts parts = counts();
    const Parts seconds = each();
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i] *= seconds[i];
    return parts;
  }

  /// Measures until the parts cover the run or the time is up.
  void measure() {
    const double start = wallSeconds();
    for (int round = 1; !interruptFlag(); ++round) {
      measureOnce();
      if (round >= kRounds && covers(covered())) return;
      if (wallSeconds() - start > kMaxSeconds) return;
    }
  }

  double covered() const {
    const Parts parts = total();
    return std::accumulate(parts.begin(), parts.end(), 0.0) / run_s_;
  }

 private:
  static RunSpec unlimited(RunSpec spec) {
    spec.time_limit = 0;
    return spec;
  }
  static RunSpec startOf(RunSpec spec) {
    spec.t_end = sceneOf<double>(spec).start.t;
    return unlimited(spec);
  }

  // The end of the run in the scene's unknowns, with the accelerations of its start.
  static State<double> endOf(const RunSpec& spec, const RunRecord& record) {
    State<double> state = sceneOf<double>(spec).start;
    state.t = record.t;
    state.u = record.u;
    state.v = record.v;
    state.x = record.x;
    state.z() = record.z;
    return state;
  }

  void measureOnce() {
    const auto take = [](double& least, const std::function<void()>& call) {
      least = std::min(least, batchSeconds(call));
    };
    take(run_s_, [this] { run_->integrate(); });
    double stages = std::numeric_limits<double>::infinity(), begin = stages, first = stages;
    take(stages, [this] { kernel_.residuals(); });
    take(begin, [this] { start_->integrate(); });
    take(first, [this] { kernel_.firstMatrices(); });
    auto& [residual, jacobian, factorization, solve, filter_factorization, filter_solve, update, step, start] = each_;
    residual = std::min(residual, stages / static_cast<double>(kernel_.stages()));
    take(jacobian, [this] { kernel_.jacobian(); });
    take(factorization, [this] { kernel_.factorize(); });
    take(solve, [this] { kernel_.solve(); });
    if (counters_.filter_solves > 0) {
      take(filter_factorization, [this] { kernel_.factorizeFilter(); });
      take(filter_solve, [this] { kernel_.solveFilter(); });
    } else {
      filter_factorization = filter_solve = 0;
    }
    take(update, [this] { kernel_.update(); });
    take(iteration_s_, [this] { kernel_.iteration(); });
    take(attempts_s_, [this] { attempts_ = kernel_.attempts(); });
    take(step, [this] { kernel_.step(); });
    // One Jacobian and the first factorizations are counted under their own names; the rest is the search for the
    // pattern and its analysis.
    const auto factors = static_cast<double>(kernel_.sparse() ? kernel_.steppers() : 0);
    start = std::min(start, begin + std::max(first - jacobian - factors * factorization, 0.0));
  }

  // The time of the counted operations of a step. In a Jacobian by differences, the residuals are part of it.
  double partsOf(const Counters& step, const Parts& parts) const {
    const auto& [residual, jacobian, factorization, solve, filter_factorization, filter_solve, update, rest, start] =
        parts;
    const std::int64_t residuals = step.residuals - step.jacobians * kernel_.residualsPerJacobian();
    const auto time = [](std::int64_t count, double seconds) { return static_cast<double>(count) * seconds; };
    return time(residuals, residual) + time(step.jacobians, jacobian) + time(step.factorizations, factorization) +
           time(step.solves, solve) + time(step.filter_factorizations, filter_factorization) +
           time(step.filter_solves, filter_solve) + time(step.newton_iterations, update);
  }

  // How often the run used each part. Residuals inside difference quotients belong to the Jacobian; those of
  // consistent start values and of the search for a pattern belong to the start.
  Parts counts() const {
    const Counters& run = counters_;
    const auto number = [](std::int64_t count) { return static_cast<double>(count); };
    const std::int64_t jacobians = run.jacobians - start_counters_.jacobians;
    const auto inside =
        (jacobians - 1) * kernel_.residualsPerJacobian() + kernel_.residualsOfFirst() + start_counters_.residuals;
    return {number(std::max<std::int64_t>(run.residuals - inside, 0)),
            number(jacobians),
            number(run.factorizations),
            number(run.solves),
            number(run.filter_factorizations),
            number(run.filter_solves),
            number(run.newton_iterations),
            number(run.steps_accepted + run.steps_rejected_error + run.steps_rejected_newton),
            1};
  }

  NewtonKernel kernel_;
  std::unique_ptr<PreparedRun> run_, start_;
  Counters counters_, start_counters_;
  Parts each_ = filled();
  double run_s_ = std::numeric_limits<double>::infinity(), iteration_s_ = run_s_;
  double attempts_s_ = run_s_;  // of two attempted steps, with what they counted
  std::optional<Counters> attempts_;

  static Parts filled() {
    Parts parts;
    parts.fill(std::numeric_limits<double>::infinity());
    return parts;
  }
};

TableRow phaseRow(const Table& runs, const TableRow& run, TableRow row, const RunSpec& spec) {
  PhaseMeasurement measurement(spec, spec.t_end / numberAt(runs, run, "steps_accepted"));
  measurement.measure();
  const Parts total = measurement.total();
  const double sum = std::accumulate(total.begin(), total.end(), 0.0);
  row.push_back(textAt(runs, run, "rtol"));
  row.push_back(std::to_string(measurement.unknowns()));
  for (const double seconds : measurement.each()) row.push_back(numberText(seconds));
  for (const double seconds : total) row.push_back(numberText(seconds / sum));
  row.push_back(numberText(measurement.runSeconds()));
  row.push_back(numberText(measurement.covered()));
  return row;
}

std::vector<std::string> phaseColumns(const Table& runs) {
  auto columns = seriesColumns(runs);
  columns.insert(columns.end(), {"rtol", "n"});
  for (const auto part : kParts) columns.push_back(fmt::format("{}_s", part));
  for (const auto part : kParts) columns.push_back(fmt::format("share_{}", part));
  columns.insert(columns.end(), {"run_s", "covered"});
  return columns;
}

}  // namespace

std::string doubtfulShares(const Table& phases) {
  std::size_t doubtful = 0;
  double least = kMaxCovered, most = kMinCovered;
  for (const auto& row : phases.rows) {
    const double covered = numberAt(phases, row, "covered");
    if (covers(covered)) continue;
    ++doubtful;
    least = std::fmin(least, covered);
    most = std::fmax(most, covered);
  }
  if (doubtful == 0) return {};
  return fmt::format(
      "the shares of {} of {} runs are doubtful: their parts cover {:.3g} to {:.3g} of the run's time, not {} to {}; "
      "phases.csv has all of them, --fresh measures again",
      doubtful, phases.rows.size(), least, most, kMinCovered, kMaxCovered);
}

Table phaseTable(const Study& study, const RunFile& runs, std::ostream& out) {
  const Table& names = runs.names();
  Table table{names.head, phaseColumns(names), {}};
  Progress progress(out, study.id + " phases");
  repeatRuns(study, runs, &progress, [&](const RunSeries& series, const TableRow& row, const RunSpec& spec) {
    table.rows.push_back(phaseRow(names, row, series.name, spec));
  });
  return table;
}

Analysis phasesAnalysis() {
  return {.key = "phases",
          .meaning = "shares of residuals, Jacobians, factorizations and solves in a run's time",
          .writes = "phases.csv",
          .one_method = "the parts of a run are timed with one method's matrices",
          .run = [](const AnalysisInput& in) {
            const Table phases = phaseTable(in.study, in.runs, in.progress);
            writeTable(in.folder / "phases.csv", phases);
            const std::string doubt = doubtfulShares(phases);
            if (!doubt.empty()) fmt::print(in.progress, "{}: {}\n", in.study.id, doubt);
          }};
}

}  // namespace irk
