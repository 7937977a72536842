// Runs with their error bars.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "irk/error_bar.h"
#include "tests/core/support.h"

namespace irk::test {

/// What measures the error of a run with these options by Radau IIA: another family of variable order.
inline Integrator<double> secondOf(const std::shared_ptr<const System<double>>& system,
                                   const IntegratorOptions& options) {
  return {system, makeMethods<double>("lobatto_iiic", 13, 4), independentOptions<double>(options)};
}

struct MeasuredRun {
  Solution<double> first, second;
  ErrorBar bar;
  std::int64_t steps = 0;  ///< of all integrations that measure
};

/// A run, which succeeds, and its bar, which is known.
template <class P>
MeasuredRun measuredRun(const P& problem, const State<double>& start, double t_end, const IntegratorOptions& options,
                        Formulation formulation = Formulation::kIndex2) {
  const auto system = makeSystem<double>(problem, {formulation});
  Integrator<double> one(system, makeTableau<double>("radau_iia_3"), options);
  auto other = secondOf(system, options);
  MeasuredRun run;
  run.first = one.integrate(start, t_end);
  EXPECT_EQ(run.first.outcome, Outcome::kSuccess) << run.first.detail;
  Monitor<double> monitor;
  monitor.accepted = [&](const StepRecord<double>&) { ++run.steps; };
  run.bar = measureErrorBar(run.first.state, other, start, options.tolerances, {}, run.second, monitor);
  EXPECT_TRUE(run.bar.known()) << run.bar.problem;
  return run;
}

}  // namespace irk::test
