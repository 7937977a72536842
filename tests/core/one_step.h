// One step of a problem with the parts of the solver that take it.
#pragma once

#include <memory>

#include "core/estimates/embedded.h"
#include "core/steps/stepper.h"
#include "tests/core/support.h"

namespace irk::test {

/// A stepper with its embedded estimate. Errors are measured in `tolerances`, which need not be those of the options.
template <class P>
struct OneStep {
  OneStep(const P& problem, const std::string& method, const IntegratorOptions& with, const Tolerances& tolerances)
      : options(with),
        system(makeSystem<double>(problem)),
        scheme(makeTableau<double>(method)),
        norm(*system, tolerances, {}),
        jacobian(*system, scheme, options, counters),
        stepper(*system, scheme, options, jacobian, norm, counters),
        estimate(*system, scheme, options, stepper.matrix(), norm, counters),
        from(system->sizes()),
        to(from) {}

  [[nodiscard]] Outcome solve(const State<double>& start, double h) {
    from = start;
    norm.update(from);
    return stepper.attempt(stepper.stages(), from, h, to).outcome;
  }

  IntegratorOptions options;
  Counters counters;
  std::shared_ptr<const System<double>> system;
  Scheme<double> scheme;
  ErrorNorm<double> norm;
  SharedJacobian<double> jacobian;
  Stepper<double> stepper;
  EmbeddedEstimate<double> estimate;
  State<double> from, to;
};

}  // namespace irk::test
