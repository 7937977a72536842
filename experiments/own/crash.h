// What the program says when code of a user's crashes it.
#pragma once

#include <filesystem>

namespace irk::own {

/// From now on a crash (a bad address, a failed assertion, a division by zero of integers) ends the program with exit
/// status 1 and a message on standard error that names `file` and how to find the place. Rows of finished runs are
/// stored already. Of several files the last is named.
void explainCrashes(const std::filesystem::path& file);

/// Whether files of users are to be compiled with checks of indices and sizes (IRK_CHECKED in the environment).
bool wantsChecks();

}  // namespace irk::own
