// Runs of integrators of other libraries.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "experiments/runs/fields.h"
#include "experiments/runs/run.h"

namespace irk {

inline RunSpec peerSpec(const std::string& method, const std::string& rest, double tol = 1e-8) {
  RunSpec run = parseSpec("method=" + method + ";" + rest);
  run.options.tolerances.rtol = run.options.tolerances.atol = tol;
  return run;
}

inline RunRecord peerSuccess(const RunSpec& run) {
  RunRecord record = execute(run);
  EXPECT_TRUE(record.succeeded()) << run.method << ": " << record.outcome << " " << record.detail;
  return record;
}

}  // namespace irk
