// What the program says when code of a user's does not return.
#pragma once

#include <filesystem>

namespace irk::own {

/// From now on a line on standard error asks once whether code of `file` does not end: after `seconds` of the process's
/// CPU time without stillGoing(). Of several files the last is named.
void askWhenStuck(const std::filesystem::path& file, int seconds);

/// A step has ended. Safe for threads; costs nothing that could be measured.
void stillGoing();

}  // namespace irk::own
