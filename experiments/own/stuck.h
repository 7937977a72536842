// Messages for a user's code that does not return.
#pragma once

#include <string>

namespace irk::own {

/// From now on a line on standard error asks once whether code of `files` does not end: after `seconds` of the
/// process's CPU time without a call of stillGoing(). Replaces what was asked before.
void askWhenStuck(const std::string& files, int seconds);

/// Call it when a run begins and when a step has ended. If the run has a time limit (> 0), the program ends with status
/// 1 if no further call follows within these seconds plus one time limit for each processor, all of which may be
/// working. Thread-safe; its cost cannot be measured.
void stillGoing(double time_limit);

}  // namespace irk::own
