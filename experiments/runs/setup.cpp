#include "experiments/runs/setup.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/number_text.h"
#include "core/base/text.h"
#include "core/base/threads.h"
#include "core/control/order_controller.h"
#include "core/derivatives/constraint_check.h"
#include "core/estimates/variable_order.h"
#include "experiments/base/decimal.h"
#include "experiments/runs/peers/catalogue.h"
#include "irk/dependent_constraints.h"
#include "irk/multiprecision.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

template <class Real>
Methods<Real> methodsOf(const RunSpec& spec) {
  if (findPeer(spec.method)) {
    throw Misuse("method '" + spec.method + "' is an integrator of another library: it has no tableau");
  }
  refuseFamilyOfFixedOrder(spec);
  if (!choosesOrder(spec.options.order)) return makeTableau<Real>(spec.method);
  return makeMethods<Real>(spec.method, spec.max_stages, firstStages(spec.options.tolerances));
}

// "6 constraints, rank 5: left out g[4]"; empty if none is left out.
template <class Real>
std::string leftOutText(const System<Real>& system) {
  const auto& left_out = constrainedIn(system).leftOut();
  if (left_out.empty()) return {};
  const Index all = constrainedIn(system).sizes().constraints;
  std::vector<std::string> names;
  for (const Index i : left_out) names.push_back(fmt::format("g[{}]", i));
  return fmt::format("{} constraints, rank {}: left out {}", all, all - std::ssize(left_out), fmt::join(names, ", "));
}

// With the constraints that the spec leaves out.
template <class Real>
SystemOptions systemOptions(const RunSpec& spec, const Scene<Real>& scene) {
  SystemOptions options{spec.formulation, spec.scaling, spec.discontinuity};
  if (spec.constraints == ConstraintUse::kIndependent) {
    options.left_out = dependentConstraints(*scene.system({}), scene.start, scene.scale);
  }
  return options;
}

}  // namespace

// In index 2 only a method whose last stage is the step's end keeps the velocity constraint; with others velocities
// leave it, and at tight tolerances every step is rejected. Measured on the mechanisms with Gauss below 1e-6: of 468
// failures `index2_projected` solves 465.
template <class Real>
std::string Setup<Real>::advice(Outcome outcome) const {
  const std::string left_out = leftOutText(*system);
  if (outcome == Outcome::kSuccess) {
    const std::string one_thread = oneThreadText(spec, system->sizes().n());
    return left_out + (left_out.empty() || one_thread.empty() ? "" : "; ") + one_thread;
  }
  if (outcome == Outcome::kSingular && spec.constraints == ConstraintUse::kAll) {
    const bool dependent = !dependentConstraints(*scene.system({}), scene.start, scene.scale).empty();
    return dependent ? "constraints 'independent' leaves out those that follow from the others" : "";
  }
  const bool steps_shrink = outcome == Outcome::kStepTooSmall || outcome == Outcome::kStalled;
  const Tableau<Real>& method = methods.members()[methods.start];
  const Vec<Real> beside = method.A.row(method.stages() - 1).transpose() - method.b;
  constexpr double kRoundOff = 1e-12;  // of coefficients with 15 digits
  const bool at_end = static_cast<double>(Real(beside.cwiseAbs().maxCoeff())) < kRoundOff;
  if (!steps_shrink || at_end) return left_out;
  const std::string before = (left_out.empty() ? "" : left_out + "; ") + "the steps of " + method.id;
  if (spec.formulation == Formulation::kIndex2 && system->sizes().constraints > 0) {
    return before + " end off the velocity constraint; formulation index2_projected projects them";
  }
  const auto& powers = system->errorPowers().z;
  const auto others = powers.begin() + static_cast<std::ptrdiff_t>(system->sizes().constraints);
  const bool has_index_2 = std::any_of(others, powers.end(), [](int power) { return power > 0; });
  if (!has_index_2) return left_out;
  return before + " end off the equations of index 2; those of radau_iia and lobatto_iiic end on them";
}

std::string oneThreadText(const RunSpec& spec, Index unknowns) {
  if (spec.options.threads == 1 || unknowns >= kThreadsFrom) return {};
  return fmt::format("threads = {} does not pay with {} unknowns: below {} one thread is taken", spec.options.threads,
                     unknowns, kThreadsFrom);
}

std::string oneThreadText(const RunSpec& spec) {
  if (spec.options.threads == 1 || findPeer(spec.method)) return {};
  return oneThreadText(spec, makeSetup<double>(spec).system->sizes().n());
}

Vec<double> systemScale(const Vec<double>& scene, const Sizes& system) {
  Vec<double> all = Vec<double>::Ones(system.components());
  const Index known = std::min(scene.size(), all.size());
  all.head(known) = scene.head(known);
  return all;
}

template <class Real>
Vec<double> toleranceScale(const Scene<Real>& scene, const RunSpec& spec, const Sizes& system) {
  Vec<double> scale = systemScale(scene.scale, system);
  for (const auto& [name, value] : spec.atol_of) {
    const auto at = std::find(scene.names.begin(), scene.names.end(), name);
    const Index i = at - scene.names.begin();
    if (at == scene.names.end()) throw Misuse("atol_of: " + unknownName("component of " + scene.id, name, scene.names));
    if (i < scale.size()) scale[i] = parseNumber("atol_of", value, kPositive) / spec.options.tolerances.atol;
  }
  return scale;
}

template <class Real>
Scene<Real> sceneOf(const RunSpec& spec) {
  auto scene = makeScene<Real>(spec.scene, settingsAtStep(spec));
  if (!std::isnan(spec.t_end)) requireInTables(scene, spec.t_end);
  return scene;
}

template <class Real>
Setup<Real> makeSetup(const RunSpec& given) {
  RunSpec spec = resolved(given);
  auto scene = sceneOf<Real>(spec);
  return setUp(std::move(spec), std::move(scene));
}

template <class Real>
Setup<Real> setUp(RunSpec spec, Scene<Real> scene) {
  auto methods = methodsOf<Real>(spec);
  auto system = scene.system(systemOptions(spec, scene));
  auto scale = toleranceScale(scene, spec, system->sizes());
  return {std::move(spec), std::move(scene), std::move(system), std::move(methods), std::move(scale)};
}

template <class Real>
Integrator<Real> newIntegrator(const RunSpec& spec, const Scene<Real>& scene) {
  const auto system = scene.system(systemOptions(spec, scene));
  Vec<double> scale = toleranceScale(scene, spec, system->sizes());
  if ((scale.array() == 1).all()) scale = {};  // the same for the integrator, which then copies none
  return {system, methodsOf<Real>(spec), spec.options, scale};
}

template <class Real>
State<Real> startWith(const Scene<Real>& scene, const Settings& components) {
  State<Real> start = scene.start;
  const Index nu = start.u.size(), known = 2 * nu + start.x.size();
  const std::vector<std::string> names(scene.names.begin(), scene.names.begin() + known);
  for (const auto& [name, value] : components) {
    const Index at = std::find(names.begin(), names.end(), name) - names.begin();
    if (at == known) throw Misuse("--start: " + unknownName("component of u, v, x", name, names));
    static_cast<void>(parseNumber("--start " + name, value, kAnyNumber));
    Real& y = at < nu ? start.u[at] : at < 2 * nu ? start.v[at - nu] : start.x[at - 2 * nu];
    y = decimalNumber<Real>(value);
  }
  return start;
}

template Vec<double> toleranceScale(const Scene<double>&, const RunSpec&, const Sizes&);
template Vec<double> toleranceScale(const Scene<BigFloat>&, const RunSpec&, const Sizes&);
template Scene<double> sceneOf(const RunSpec&);
template Scene<BigFloat> sceneOf(const RunSpec&);
template State<double> startWith(const Scene<double>&, const Settings&);
template State<BigFloat> startWith(const Scene<BigFloat>&, const Settings&);
template Setup<double> setUp(RunSpec, Scene<double>);
template Setup<BigFloat> setUp(RunSpec, Scene<BigFloat>);
template Integrator<double> newIntegrator(const RunSpec&, const Scene<double>&);
template Integrator<BigFloat> newIntegrator(const RunSpec&, const Scene<BigFloat>&);
template std::string Setup<double>::advice(Outcome) const;
template std::string Setup<BigFloat>::advice(Outcome) const;
template Setup<double> makeSetup(const RunSpec&);
template Setup<BigFloat> makeSetup(const RunSpec&);

}  // namespace irk
