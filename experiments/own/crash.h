// What the program says when code of a user's crashes it, ends it, throws, or does not return.
#pragma once

#include <filesystem>

namespace irk::own {

/// From now on a crash (a bad address, a failed assertion, a division by zero of integers) ends the program with exit
/// status 1 and a message on standard error that names `file` and how to find the place. Rows of finished runs are
/// stored already. Exceptions and endless loops, too, are told with the name of the file, and so is a call of exit() as
/// long as an ExitGuard lives. Of several files the last is named.
void explainCrashes(const std::filesystem::path& file);

/// While one lives, exit() is a mistake of the user's file.
class ExitGuard {
 public:
  ExitGuard();
  ~ExitGuard();
  ExitGuard(const ExitGuard&) = delete;
  ExitGuard& operator=(const ExitGuard&) = delete;
};

/// Ends the duty of all guards: the program itself is about to call exit(), as MPI_Abort does.
void allowExit();

/// Whether files of users are to be compiled with checks of indices and sizes (IRK_CHECKED in the environment).
bool wantsChecks();

}  // namespace irk::own
