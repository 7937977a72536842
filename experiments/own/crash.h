// Messages for a user's code that crashes the program, ends it, throws, or does not return.
#pragma once

#include <filesystem>
#include <string_view>

namespace irk::own {

class FixedText;

/// From now on a crash (a bad address, a failed assertion, a division by zero of integers) ends the program with exit
/// status 1 and a message on standard error that names the file and how to find the place. Rows of finished runs are
/// already stored then. In this thread, until a Running exists, the file is `file`. Messages about endless loops and,
/// as long as an ExitGuard exists, calls of exit() name all files that were given.
void explainCrashes(const std::filesystem::path& file);

/// As long as one exists, a crash of this thread is one of this code: `code of a.cpp or b.so`. Without code it may come
/// of what any code that was loaded has written outside its arrays before.
class Running {
 public:
  /// The message of a crash, which is kept until the program ends.
  static const FixedText* messageOf(std::string_view code);

  explicit Running(const FixedText* message);
  ~Running();
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

 private:
  const FixedText* before_;
};

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
