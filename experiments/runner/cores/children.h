// Calls in child processes of this program, each on a processor of its own.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace irk::cores {

/// What a call has given.
struct Answer {
  std::vector<double> numbers;
  /// Why there are no numbers: the exception that was thrown, or how the process ended. Empty: there are.
  std::string failure;
};
using Call = std::function<std::vector<double>()>;
using Done = std::function<void(const Answer& answer)>;

/// Makes the call in this process; an exception is a failure.
Answer answerOf(const Call& call);

/// Makes calls at the same time, one on each of some processors. A call sees the memory of this process as it was when
/// it began (fork). Of what it does only its numbers come back. Of this process's threads only the calling one lives
/// on in it: a call may not use threads of OpenMP, of a team (core/base/threads.h) or of MPI. SIGINT and SIGTERM do not
/// end it, so that an interrupt loses no finished call; it ends when this process ends. Not thread-safe.
class Children {
 public:
  /// At least one processor.
  explicit Children(const std::vector<int>& processors);
  /// Kills the calls that have not ended.
  ~Children();
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  /// Begins the call; if no processor is free, another call ends before. `done` gets its answer in this process, during
  /// a later `begin` or `finish`; its exceptions leave these. Throws Failure if no process can be started.
  void begin(const Call& call, Done done);
  /// Returns when all calls have ended.
  void finish();

 private:
  struct Place {
    int processor;
    pid_t process = 0;  ///< 0: free
    int pipe = -1;
    std::string message;  ///< what has come so far
    Done done;
  };
  Place* freePlace();
  void endOne();
  void read(Place& place);

  std::vector<Place> places_;
};

}  // namespace irk::cores
