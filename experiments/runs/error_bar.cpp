#include "experiments/runs/error_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/options/fixed_steps.h"
#include "experiments/base/clock.h"
#include "experiments/base/decimal.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/setup.h"
#include "experiments/runs/texts/component_names.h"
#include "irk/multiprecision.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

IntegratorOptions optionsFor(const RunSpec& spec) {
  if (spec.scalar.isDouble()) return independentOptions<double>(spec.options);
  const WorkingDigits digits(spec.scalar.digits);
  return independentOptions<BigFloat>(spec.options);
}

// The largest |e| / max(|y|, scale); `place`: of the first component among u, v, x, z.
double relative(const Vec<double>& errors, const auto& y, const Vec<double>& scale, Index place, double largest) {
  for (Index i = 0; i < errors.size(); ++i) {
    const double magnitude = place + i < scale.size() ? scale[place + i] : 1;
    largest = std::fmax(largest, errors[i] / std::max(std::abs(static_cast<double>(y[i])), magnitude));
  }
  return largest;
}

// Radau IIA needs fewer steps than Lobatto IIIC, which measures its methods, and all that may have its nodes: tableaus
// from files, solvers of other libraries.
std::string otherFamily(const std::string& method) {
  const std::string_view family = familyOfId(method);
  return family.empty() || family == "radau_iia" ? "lobatto_iiic" : "radau_iia";
}

}  // namespace

RunSpec independentSpec(const RunSpec& spec) {
  RunSpec second = spec;
  second.settings = settingsAtStep(spec);
  second.configuration = "variable";
  second.method = otherFamily(spec.method);
  second.formulation = RunSpec{}.formulation;
  second.scaling = RunSpec{}.scaling;
  if (spec.discontinuity != Discontinuity::kSmooth) second.discontinuity = Discontinuity::kLocate;
  second.options = optionsFor(spec);
  const double stricter = second.options.tolerances.atol / spec.options.tolerances.atol;
  for (auto& [name, value] : second.atol_of) {
    value = numberText(stricter * parseNumber("atol_of", value, kPositive));
  }
  second.max_stages = RunSpec{}.max_stages;
  second.reference = ReferenceUse::kNone;
  second.reference_times = 1;
  second.error_bar = ErrorBarUse::kNone;
  return second;
}

RunSpec strictRun(const RunSpec& question, IndependentFamily family, double tolerance, double h_max) {
  RunSpec loose = question;  // a run of the other family with ten times the tolerance
  loose.method = family == IndependentFamily::kRadauIIA ? "lobatto_iiic_4" : "radau_iia_5";
  loose.options.tolerances.rtol = loose.options.tolerances.atol = 10 * tolerance;
  loose.options.step.h_max = h_max;
  RunSpec strict = independentSpec(resolved(loose));
  strict.options.tolerances.rtol = strict.options.tolerances.atol = tolerance;  // not rounded
  return strict;
}

namespace {

template <class Real>
struct Measurement {
  ErrorBar bar;         // with the scene's names in its texts
  State<Real> better;   // the result of the integration that measures
  double cpu_s = 0;     // of this integration
  bool refines = true;  // whether `better` is by a stricter integration than the run
};

// Measures the error of a result of `spec` by the run `measuring`.
template <class Real>
Measurement<Real> measuredBy(const RunSpec& measuring, const RunSpec& spec, const Scene<Real>& scene,
                             const State<Real>& result, const MeasuringWatch& watch) {
  const auto setup = setUp<Real>(measuring, scene);
  auto integrator = setup.integrator();
  const double began = threadSeconds();
  Monitor<Real> monitor;
  double t = static_cast<double>(scene.start.t);
  const double t0 = t, length = static_cast<double>(result.t) - t0;
  // The integration ends at its own time of the switch.
  const auto t_end = spec.options.stop_at.empty() ? std::nullopt : std::optional(decimalNumber<Real>(spec.t_end));
  monitor.interrupt = [&] {
    if (watch.progress) watch.progress(length > 0 ? (t - t0) / length : 1);
    return watch.interrupt();
  };
  if (watch.progress) monitor.accepted = [&t](const StepRecord<Real>& step) { t = static_cast<double>(step.t); };
  Solution<Real> second;
  ErrorBar bar = measureErrorBar(result, integrator, scene.start, spec.options.tolerances,
                                 toleranceScale(scene, spec, scene.sizes()), second, monitor, t_end);
  bar.problem = withNames(bar.problem, scene.names, scene.sizes(), setup.system->sizes());
  bar.remark = withNames(bar.remark, scene.names, scene.sizes(), setup.system->sizes());
  return {std::move(bar), std::move(second.state), threadSeconds() - began};
}

// The same by `second` with the run's own tolerance, after the stricter integration `failed`.
template <class Real>
Measurement<Real> measuredLessStrictly(RunSpec second, const RunSpec& spec, const Scene<Real>& scene,
                                       const State<Real>& result, const MeasuringWatch& watch,
                                       Measurement<Real> failed) {
  second.options.tolerances = spec.options.tolerances;
  second.atol_of = spec.atol_of;
  Measurement<Real> again = measuredBy(second, spec, scene, result, watch);
  failed.cpu_s += again.cpu_s;
  if (!again.bar.known()) return failed;
  const std::string lacks = again.bar.remark.empty() ? "" : "; " + again.bar.remark;
  const char* const too_small = asksForStricter(again.bar) ? "; so large a bar may be too small" : "";
  again.bar.remark =
      "measured at the run's own tolerance: with a stricter one, " + failed.bar.problem + lacks + too_small;
  return {std::move(again.bar), std::move(again.better), failed.cpu_s, false};
}

bool differ(const Tolerances& a, const Tolerances& b) { return a.rtol != b.rtol || a.atol != b.atol; }

// The same by independentSpec. If that fails, by the same with the run's own tolerance; if the bar asks for it, once
// more by independentSpec of the second run.
template <class Real>
Measurement<Real> measured(const RunSpec& spec, const Scene<Real>& scene, const State<Real>& result,
                           const MeasuringWatch& watch) {
  const RunSpec second = independentSpec(spec);
  Measurement<Real> of = measuredBy(second, spec, scene, result, watch);
  if (hasFixedSteps(spec.options.step)) return of;
  if (!of.bar.known()) {
    const bool goes_on = watch.interrupt() == Outcome::kSuccess;
    if (!goes_on || !differ(second.options.tolerances, spec.options.tolerances)) return of;
    return measuredLessStrictly(second, spec, scene, result, watch, std::move(of));
  }
  if (!asksForStricter(of.bar)) return of;
  Measurement<Real> again = measuredBy(independentSpec(second), spec, scene, result, watch);
  of.cpu_s += again.cpu_s;
  if (again.bar.known()) {
    of.bar = larger(of.bar, again.bar);
    of.better = std::move(again.better);
  } else if (of.bar.remark.empty()) {
    of.bar.remark = "so large a bar may be too small: measured again, " + again.bar.problem;
  }
  return of;
}

}  // namespace

template <class Real>
RunErrorBar measuredErrorBar(const RunSpec& spec, const Scene<Real>& scene, Solution<Real>& solution,
                             const MeasuringWatch& watch) {
  if (spec.error_bar == ErrorBarUse::kNone || solution.outcome != Outcome::kSuccess) return {};
  const State<Real>& result = solution.state;
  const auto [bar, better, cpu_s, refines] = measured(spec, scene, result, watch);
  RunErrorBar told{bar};
  told.cpu_s = cpu_s;
  if (!told.known()) return told;
  const auto worst = static_cast<std::size_t>(std::max<Index>(bar.worst, 0));
  if (worst < scene.names.size()) told.component = scene.names[worst];
  const Index nu = result.u.size(), nx = result.x.size();
  told.error = relative(bar.u, better.u, scene.scale, 0, told.error);
  told.error = relative(bar.v, better.v, scene.scale, nu, told.error);
  told.error = relative(bar.x, better.x, scene.scale, 2 * nu, told.error);
  told.error_z = relative(bar.z, better.z(), scene.scale, 2 * nu + nx, told.error_z);
  told.refined = refines && spec.error_bar == ErrorBarUse::kRefined;
  if (told.refined) solution.state = better;
  return told;
}

std::string doubtOf(const RunErrorBar& bar, const RunSpec& spec) {
  const bool judged = spec.error_bar != ErrorBarUse::kNone && !bar.refined && !hasFixedSteps(spec.options.step);
  if (!judged || !(bar.tolerances > largestErrorBar(spec.options.tolerances))) return {};
  return fmt::format("the error bar is {:.2g} tolerances, largest in {}", bar.tolerances, bar.component);
}

#define IRK_MEASURED(Real) \
  template RunErrorBar measuredErrorBar(const RunSpec&, const Scene<Real>&, Solution<Real>&, const MeasuringWatch&);
IRK_MEASURED(double)
IRK_MEASURED(BigFloat)
#undef IRK_MEASURED

}  // namespace irk
