// Shared by tests of located switches.
#pragma once

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/core/switching_run.h"

namespace irk::test {

inline IntegratorOptions located(double tol) {
  IntegratorOptions o = adaptive(tol);
  o.step.estimate = ErrorEstimate::kRichardson;
  o.step.control = StepControl::kPredictive;
  o.newton.kind = NewtonKind::kSimplified;
  o.predictor = Predictor::kExtrapolated;
  o.jacobian_point = JacobianPoint::kStart;
  o.multipliers = Multipliers::kConsistent;
  return o;
}

}  // namespace irk::test
