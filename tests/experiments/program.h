// Calls the program as a user does: arguments in, exit status and output out.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "experiments/commands/cli.h"

namespace irk {

struct Ended {
  int status;
  std::string out, err;
};

inline Ended program(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int status = runProgram(arguments, {out, err});
  return {status, out.str(), err.str()};
}

}  // namespace irk
