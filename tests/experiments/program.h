// Calls the program as a user does: arguments in, exit status and output out.
#pragma once

#include <gtest/gtest.h>
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/commands/cli.h"
#include "tests/experiments/solve_schema.h"

namespace irk {

struct Ended {
  int status;
  std::string out, err;
};

/// What `irk solve --json` prints has to follow its schema.
inline Ended program(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int status = runProgram(arguments, {out, err});
  const bool json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
  if (json && arguments.front() == "solve" && !out.str().empty()) {
    EXPECT_EQ(againstSolveSchema(out.str()), std::vector<std::string>{});
  }
  return {status, out.str(), err.str()};
}

}  // namespace irk
