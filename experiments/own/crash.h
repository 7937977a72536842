// Messages for a user's code that crashes the program, ends it, throws, or does not return.
#pragma once

#include <filesystem>

namespace irk::own {

/// From now on a crash (a bad address, a failed assertion, a division by zero of integers) ends the program with exit
/// status 1 and a message on standard error that names `file` and how to find the place. Rows of finished runs are
/// already stored then. Messages about exceptions, endless loops and, as long as an ExitGuard exists, calls of exit()
/// name the file as well. If several files were given, the last one is named.
void explainCrashes(const std::filesystem::path& file);

/// As long as one exists, a call of exit() counts as a mistake of the user's file.
class ExitGuard {
 public:
  ExitGuard();
  ~ExitGuard();
  ExitGuard(const ExitGuard&) = delete;
  ExitGuard& operator=(const ExitGuard&) = delete;
};

/// Ends the effect of all guards: the program itself is about to call exit(), as MPI_Abort does.
void allowExit();

/// Whether files of users are to be compiled with checks of indices and sizes (IRK_CHECKED in the environment).
bool wantsChecks();

}  // namespace irk::own
