// Systems for which integrators easily return wrong results.
#pragma once

#include <gtest/gtest.h>
#include <cmath>

#include "core/control/stall_detector.h"
#include "core/steps/switch_scan.h"
#include "tests/core/switching_run.h"

namespace irk::test {

inline IntegratorOptions embedded(double tol) {
  IntegratorOptions o = adaptive(tol);
  o.step.estimate = ErrorEstimate::kEmbedded;
  return o;
}

}  // namespace irk::test
