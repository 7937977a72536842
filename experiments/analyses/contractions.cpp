#include "experiments/analyses/contractions.h"

#include <cmath>
#include <memory>
#include <string>

#include "core/newton/newton_base.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"
#include "experiments/runs/setup.h"
#include "experiments/study/analysis.h"

namespace irk {
namespace {

constexpr std::size_t kLeastIterations = 4;  // of a solve in the table: fewer show no trend
constexpr std::size_t kMostIterations = 6;   // in the table
constexpr std::size_t kSampledSolves = 100;  // solves of one run

constexpr NewtonKind kObserved{{"modified_observed"}};

// Receives the observed solves of this thread's run. It is global because a strategy is made from options only.
thread_local std::vector<Contractions>* observed = nullptr;

/// Newton 'modified'. Before each solve it makes the same solve once more and records the residuals.
class ObservedNewton final : public NewtonBase<double> {
 public:
  ObservedNewton(const IntegratorOptions& options, const Sizes& sizes, const Scheme<double>& scheme)
      : NewtonBase<double>(options, sizes, scheme),
        modified_(catalogue<NewtonKind>()[NewtonKind::kModified].make.in_double(options, sizes, scheme)) {}

  NewtonResult solve(NewtonContext<double>& c, Mat<double>& W) override {
    begin(c, W);
    refresh(c, W);  // as `modified` would do, which then finds a fresh Jacobian
    Mat<double> copy = W;
    if (observed) observed->push_back(contractions(c, copy));
    return modified_->solve(c, W);
  }
  void forget() override { modified_->forget(); }

 private:
  Contractions contractions(NewtonContext<double>& c, Mat<double>& W) {
    const NewtonOptions& o = options_.newton;
    Contractions all;
    if (!residual(c, W)) return all;
    const double first = R_.norm();
    double last = first;
    for (int i = 1; i <= o.max_iterations && last > 0; ++i) {
      if (c.matrix.prepare(c.eq.h()) != Outcome::kSuccess) break;
      const double norm = update(c, c.matrix, W);
      if (!std::isfinite(norm) || !residual(c, W)) break;
      const double eps = R_.norm();
      all.push_back(eps / last);
      last = eps;
      const bool at_round_off =
          norm <= kRoundOffUnits * round_off_ || (all.back() >= 0.5 && norm <= kStagnationUnits * round_off_);
      const bool too_slow = all.back() > o.contractivity_limit && i > o.contractivity_after;
      if (eps <= o.residual_tolerance * first || at_round_off || too_slow) break;
    }
    return all;
  }

  std::unique_ptr<Newton<double>> modified_;
};

void registerObserved() {
  static const bool done = [] {
    registerStrategy<NewtonKind>({.id = kObserved,
                                  .meaning = "newton 'modified', each solve observed",
                                  .uses_stage_matrices = true,
                                  .make = {kConstruct<ObservedNewton>, nullptr}});
    return true;
  }();
  static_cast<void>(done);
}

void appendRun(const TableRow& start, const std::string& rtol, const std::vector<Contractions>& solves,
               TableWriter& table) {
  std::vector<std::size_t> long_ones;
  for (std::size_t i = 0; i < solves.size(); ++i) {
    if (solves[i].size() >= kLeastIterations) long_ones.push_back(i);
  }
  const std::size_t stride = long_ones.size() / kSampledSolves + 1;
  for (std::size_t i = stride / 2; i < long_ones.size(); i += stride) {
    const Contractions& c = solves[long_ones[i]];
    TableRow row = start;
    row.insert(row.end(), {rtol, std::to_string(long_ones[i] + 1), std::to_string(c.size())});
    for (std::size_t k = 0; k < kMostIterations; ++k) row.push_back(k < c.size() ? numberText(c[k]) : "nan");
    table.add(row);
  }
}

}  // namespace

std::vector<Contractions> observedContractions(const RunSpec& spec) {
  registerObserved();
  const auto setup = makeSetup<double>(spec);
  IntegratorOptions options = setup.spec.options;
  options.newton.kind = kObserved;
  std::vector<Contractions> solves;
  Monitor<double> monitor;
  monitor.interrupt = [] { return interruptFlag() ? Outcome::kInterrupted : Outcome::kSuccess; };
  auto integrator = setup.integrator(setup.methods, options);
  observed = &solves;
  const auto solution = integrator.integrate(setup.scene.start, setup.spec.t_end, monitor);
  observed = nullptr;
  if (solution.outcome != Outcome::kSuccess) solves.clear();
  return solves;
}

void writeContractions(const Study& study, const RunFile& runs, const std::filesystem::path& file) {
  const Table& names = runs.names();
  auto columns = seriesColumns(names);
  columns.insert(columns.end(), {"rtol", "solve", "iterations"});
  for (std::size_t k = 1; k <= kMostIterations; ++k) columns.push_back("c" + std::to_string(k));
  TableWriter table(file, names.head, columns);
  repeatRuns(study, runs, nullptr, [&](const RunSeries& series, const TableRow& row, const RunSpec& spec) {
    if (spec.options.newton.kind != NewtonKind::kModified || !spec.scalar.isDouble()) return;
    appendRun(series.name, textAt(names, row, "rtol"), observedContractions(spec), table);
  });
  table.close();
}

Analysis contractionsAnalysis() {
  return {.key = "contractions",
          .meaning = "Newton's contraction, iteration by iteration",
          .writes = "contractions.csv",
          .one_method = "the iterations of one method are counted",
          .run = [](const AnalysisInput& in) { writeContractions(in.study, in.runs, in.folder / "contractions.csv"); }};
}

}  // namespace irk
