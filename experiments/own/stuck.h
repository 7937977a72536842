// What the program says when code of a user's does not return.
#pragma once

#include <filesystem>

namespace irk::own {

/// From now on a line on standard error asks once whether code of `file` does not end: after `seconds` of the process's
/// CPU time without stillGoing(). Of several files the last is named.
void askWhenStuck(const std::filesystem::path& file, int seconds);

/// A run begins, or a step has ended. If the run has a time limit (> 0), the program ends with status 1 when the code
/// is still silent after these seconds and another time limit for each processor, all of which may be at work. Safe for
/// threads; costs nothing that could be measured.
void stillGoing(double time_limit);

}  // namespace irk::own
