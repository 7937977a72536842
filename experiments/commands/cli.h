// The command line.
#pragma once

#include <string>
#include <vector>

#include "experiments/base/streams.h"

namespace irk {

/// Runs `irk arguments...` and returns the exit status: 0 for success; kFailedStatus, also if output cannot be
/// written; kMisuseStatus with one line `irk: what, where, what is allowed` on `err`; kInterruptedStatus. Never
/// throws.
int runProgram(const std::vector<std::string>& arguments, Streams streams);

}  // namespace irk
