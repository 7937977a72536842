#include "experiments/analyses/estimates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/estimates/step_attempt.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/run_errors.h"
#include "experiments/runs/run_table.h"
#include "experiments/runs/setup.h"
#include "experiments/study/analysis.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

constexpr int kSampledSteps = 24;  // steps of one run
constexpr Index kMoreStages = 4;   // of the accurate solution, beyond those of the method
constexpr int kSubsteps = 4;       // steps of the accurate solution per sampled step
constexpr double kRoundOff = 1000 * std::numeric_limits<double>::epsilon();

struct Step {
  State<double> from;
  double h;
};

/// One scene in one formulation; repeats its steps with any method.
class StepSampler {
 public:
  explicit StepSampler(const RunSpec& spec) : setup_(makeSetup<double>(spec)) {}

  const Scene<double>& scene() const { return setup_.scene; }
  const System<double>& system() const { return *setup_.system; }
  const Tableau<double>& tableau() const { return setup_.methods.members()[setup_.methods.start]; }

  /// A sample of the steps that the run takes.
  std::vector<Step> steps() const {
    std::vector<Step> all;
    State<double> from = setup_.scene.start;
    Monitor<double> monitor;
    monitor.accepted = [&](const StepRecord<double>& step) {
      all.push_back({from, step.h});
      from = step.state;
    };
    auto integrator = setup_.integrator();
    static_cast<void>(integrator.integrate(setup_.scene.start, setup_.spec.t_end, monitor));
    std::vector<Step> some;
    const std::size_t stride = all.size() / kSampledSteps + 1;
    for (std::size_t i = stride / 2; i < all.size(); i += stride) some.push_back(all[i]);
    return some;
  }

  /// `count` equal steps of a method over the step's interval: u, v, x, z at its end.
  std::optional<Vec<double>> end(const Step& step, const Tableau<double>& method, int count) const {
    IntegratorOptions options = setup_.spec.options;
    options.order = OrderControl::kFixed;
    options.step.control = StepControl::kFixed;
    options.step.estimate = ErrorEstimate::kNone;
    options.step.h = step.h / count;
    options.newton.kind = NewtonKind::kSimplified;
    options.multipliers = Multipliers::kStages;  // the estimate is based on the stages' multipliers
    auto integrator = setup_.integrator(method, options);
    const auto solution = integrator.integrate(step.from, step.from.t + step.h);
    if (solution.outcome != Outcome::kSuccess) return {};
    return components(solution.state);
  }

 private:
  Setup<double> setup_;
};

struct ErrorGroup {
  char name;
  Index first, count;
};

std::vector<ErrorGroup> groupsOf(const Sizes& n) {
  return {{'u', 0, n.nu}, {'v', n.nu, n.nu}, {'x', 2 * n.nu, n.nx}, {'z', 2 * n.nu + n.nx, n.nz}};
}

double largest(const Vec<double>& y, const Vec<double>& scale, const ErrorGroup& group) {
  double most = 0;
  for (Index i = group.first; i < group.first + group.count; ++i) {
    most = std::max(most, std::abs(y[i]) / (i < scale.size() ? scale[i] : 1));
  }
  return most;
}

// Divides the error of the two half steps by the estimate computed from their difference to the whole step.
void appendStep(const StepSampler& sampler, const Step& step, const TableRow& start, const Table& runs,
                const TableRow& run, TableWriter& table) {
  const auto& tableau = sampler.tableau();
  const auto accurate = makeTableau<double>("radau_iia_" + std::to_string(tableau.stages() + kMoreStages));
  const auto coarse = sampler.end(step, tableau, 1), fine = sampler.end(step, tableau, 2);
  const auto exact = sampler.end(step, accurate, kSubsteps);
  if (!coarse || !fine || !exact) return;
  const auto& scale = sampler.scene().scale;
  const auto factors = [&](ErrorEstimate estimate) {
    return doublingFactors(Scheme<double>(tableau), sampler.system(), estimate);
  };
  const auto all = factors(ErrorEstimate::kDoubling), own = factors(ErrorEstimate::kRichardson);
  for (const ErrorGroup& group : groupsOf(sampler.scene().sizes())) {
    const double size = largest(*exact, scale, group);
    const double difference = largest(*coarse - *fine, scale, group);
    const double error = largest(*fine - *exact, scale, group);
    // Below the round-off of the group both numbers are meaningless.
    if (group.count == 0 || !(std::max(difference, error) > kRoundOff * std::max(size, 1.0))) {
      continue;
    }
    TableRow row = start;
    row.insert(row.end(),
               {textAt(runs, run, "rtol"), numberText(step.from.t), numberText(step.h), std::string(1, group.name),
                numberText(difference), numberText(error), numberText(error / (difference * all[group.first])),
                numberText(error / (difference * own[group.first]))});
    table.add(row);
  }
}

}  // namespace

void writeEstimates(const Study& study, const RunFile& runs, const std::filesystem::path& file) {
  const Table& names = runs.names();
  auto columns = seriesColumns(names);
  columns.insert(columns.end(), {"rtol", "t", "h", "group", "difference", "error", "doubling", "richardson"});
  TableWriter table(file, names.head, columns);
  repeatRuns(study, runs, nullptr, [&](const RunSeries& series, const TableRow& row, const RunSpec& spec) {
    if (spec.options.step.estimate == ErrorEstimate::kNone || !spec.scalar.isDouble()) return;
    const StepSampler sampler(spec);
    for (const Step& step : sampler.steps()) appendStep(sampler, step, series.name, names, row, table);
  });
  table.close();
}

Analysis estimatesAnalysis() {
  return {.key = "estimates",
          .meaning = "true errors of single steps over their estimates",
          .writes = "estimates.csv",
          .one_method = "the error of a step is compared with one method's estimate",
          .run = [](const AnalysisInput& in) { writeEstimates(in.study, in.runs, in.folder / "estimates.csv"); }};
}

}  // namespace irk
