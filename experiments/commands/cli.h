// The command line.
#pragma once

#include <string>
#include <vector>

#include "experiments/base/streams.h"

namespace irk {

/// Runs `irk arguments...`. Returns the exit status: 0 done; kFailedStatus; kMisuseStatus with one line
/// `irk: what, where, what is allowed` on `err`; kInterruptedStatus. Throws nothing. Output that cannot be written is
/// a failure.
int runProgram(const std::vector<std::string>& arguments, Streams streams);

}  // namespace irk
