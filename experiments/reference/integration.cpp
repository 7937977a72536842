#include "experiments/reference/integration.h"

#include <fmt/format.h>

#include "experiments/base/clock.h"
#include "experiments/base/decimal.h"
#include "experiments/own/stuck.h"
#include "experiments/runs/run_errors.h"
#include "experiments/runs/setup.h"
#include "irk/integrator.h"

namespace irk {
namespace {

// Carries out the changes at the state's time: an integration makes neither those at its last time nor those at its
// start.
template <class Real>
void passTimes(const System<Real>& system, State<Real>& state) {
  const std::vector<Real> times = system.times();
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] != state.t) continue;
    system.onTime(static_cast<Index>(i), state);
    system.jumpAtTime(static_cast<Index>(i), state);
  }
}

template <class Real>
Integrated integratedIn(const RunSpec& spec, const std::vector<std::string>& times, const IntegrationWatch& watch) {
  const double start = threadSeconds();
  const auto setup = makeSetup<Real>(spec);
  auto integrator = setup.integrator();
  Integrated result;
  State<Real> state = setup.scene.start;
  double reached = static_cast<double>(state.t);
  std::string refused;
  Monitor<Real> monitor;
  monitor.accepted = [&](const StepRecord<Real>& step) { reached = static_cast<double>(step.t); };
  monitor.interrupt = [&] {
    own::stillGoing(0);
    if (watch.stop && watch.stop->load(std::memory_order_relaxed)) return Outcome::kInterrupted;
    if (watch.refuse) refused = watch.refuse(reached, threadSeconds() - start);
    return refused.empty() ? Outcome::kSuccess : Outcome::kTimeout;
  };
  for (const auto& t : times) {
    const auto solution = integrator.integrate(state, decimalNumber<Real>(t), monitor);
    if (solution.outcome != Outcome::kSuccess) {
      result.failure = fmt::format("{} at tol {:g}: {}, {}", spec.method, spec.options.tolerances.rtol,
                                   name(solution.outcome), refused.empty() ? solution.detail : refused);
      return result;
    }
    state = solution.state;
    result.rows.push_back(componentsAndOutputs(setup.scene, state));
    if (!spec.options.stop_at.empty()) result.rows.back().push_back(BigFloat(state.t));
    passTimes(*setup.system, state);
  }
  return result;
}

}  // namespace

template <class Real>
std::vector<BigFloat> componentsAndOutputs(const Scene<Real>& scene, const State<Real>& state) {
  const Vec<Real> y = components(state);
  std::vector<BigFloat> row(y.begin(), y.end());
  for (const auto& output : scene.outputs) row.push_back(BigFloat(output.value(state)));
  return row;
}
template std::vector<BigFloat> componentsAndOutputs(const Scene<double>&, const State<double>&);
template std::vector<BigFloat> componentsAndOutputs(const Scene<BigFloat>&, const State<BigFloat>&);

Integrated integrated(const RunSpec& spec, const std::vector<std::string>& times, const IntegrationWatch& watch) {
  Integrated result;
  const WorkingDigits digits(spec.scalar.isDouble() ? WorkingDigits::now() : spec.scalar.digits);
  try {
    result =
        spec.scalar.isDouble() ? integratedIn<double>(spec, times, watch) : integratedIn<BigFloat>(spec, times, watch);
  } catch (const std::exception& error) {
    result.failure = error.what();
  }
  return result;
}

}  // namespace irk
