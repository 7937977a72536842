// Systems and step controllers that record the effects of options.
#pragma once

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>
#include <vector>

#include "core/control/controller.h"
#include "core/derivatives/differentiator.h"
#include "core/estimates/step_attempt.h"
#include "core/stages/error_norm.h"
#include "tests/core/support.h"

namespace irk::test {

struct Taken {
  Solution<double> solution;
  std::vector<double> h, error;
};

template <class P>
Taken taken(const P& problem, const State<double>& start, double t_end, const IntegratorOptions& options,
            const char* method = "radau_iia_3") {
  Integrator<double> integrator(makeSystem<double>(problem), makeTableau<double>(method), options);
  Taken all;
  Monitor<double> monitor;
  monitor.accepted = [&](const StepRecord<double>& s) {
    all.h.push_back(s.h);
    all.error.push_back(s.error);
  };
  all.solution = integrator.integrate(start, t_end, monitor);
  return all;
}

/// A mass that depends on u, v, x and z, and a constraint force whose direction depends on x and z.
struct Coupled : OnUnitCircle {
  Sizes sizes() const { return {.nu = 2, .nx = 1, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T m = 1.0 + 0.3 * p.u[0] + 0.2 * p.v[0] + 0.7 * p.x[0] + 0.05 * p.z[0];
    r.u[0] = 3.0 * p.u[1] + 2.0 * p.v[1] + p.x[0] - m * p.a[0] - p.u[0] * p.z[0];
    r.u[1] = 5.0 * p.u[0] * p.u[0] - p.a[1] - p.u[1] * p.z[0];
    r.x[0] = p.u[0] - p.x[0] * p.x[0] - p.k[0];
  }
};

}  // namespace irk::test
