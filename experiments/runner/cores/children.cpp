#include "experiments/runner/cores/children.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "experiments/base/failure.h"
#include "experiments/runner/cores/processors.h"

namespace irk::cores {
namespace {

// The first byte of a message: numbers, or the text of a failure.
constexpr char kNumbers = 'n', kFailure = 'f';

std::string messageOf(const Answer& answer) {
  if (!answer.failure.empty()) return kFailure + answer.failure;
  std::string text(1 + answer.numbers.size() * sizeof(double), kNumbers);
  std::memcpy(text.data() + 1, answer.numbers.data(), text.size() - 1);
  return text;
}

Answer answerIn(const std::string& message) {
  if (message.front() == kFailure) return {{}, message.substr(1)};
  Answer answer{std::vector<double>((message.size() - 1) / sizeof(double)), {}};
  std::memcpy(answer.numbers.data(), message.data() + 1, answer.numbers.size() * sizeof(double));
  return answer;
}

// `its process was ended by signal 9 (Killed)`
std::string endText(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("its process was ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  }
  return fmt::format("its process ended without a result, with exit status {}", WEXITSTATUS(status));
}

// In the child.
[[noreturn]] void answerThrough(int pipe, int processor, pid_t parent, const Call& call) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it has ended before that line
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_IGN);
  // A crash ends this process only, and the parent says so.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT}) std::signal(signal, SIG_DFL);
  const std::string message = messageOf(answerOf([&] {
    pinTo(processor);
    return call();
  }));
  for (std::size_t written = 0; written < message.size();) {
    const auto more = write(pipe, message.data() + written, message.size() - written);
    if (more < 0 && errno != EINTR) _exit(1);
    if (more > 0) written += static_cast<std::size_t>(more);
  }
  _exit(0);  // no destructors: files and the lock of the study belong to the parent
}

int statusOf(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

Answer answerOf(const Call& call) {
  try {
    return {call(), {}};
  } catch (const std::exception& exception) {
    const std::string text = exception.what();
    return {{}, text.empty() ? "an exception without a text" : text};
  } catch (...) {
    return {{}, "an exception of unknown kind"};
  }
}

Children::Children(const std::vector<int>& processors) {
  for (const int processor : processors) places_.push_back({.processor = processor, .message = {}, .done = {}});
}

Children::~Children() {
  for (const Place& place : places_) {
    if (place.process == 0) continue;
    kill(place.process, SIGKILL);
    statusOf(place.process);
    close(place.pipe);
  }
}

Children::Place* Children::freePlace() {
  const auto place = std::ranges::find(places_, 0, &Place::process);
  return place == places_.end() ? nullptr : &*place;
}

void Children::begin(const Call& call, Done done) {
  while (!freePlace()) endOne();
  Place& place = *freePlace();
  int ends[2];
  if (pipe(ends) != 0) throw Failure(fmt::format("no pipe to a process: {}", std::strerror(errno)));
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process == 0) answerThrough(ends[1], place.processor, parent, call);
  const int error = errno;
  close(ends[1]);
  if (process < 0) {
    close(ends[0]);
    throw Failure(fmt::format("no process can be started: {}", std::strerror(error)));
  }
  place.process = process;
  place.pipe = ends[0];
  place.message.clear();
  place.done = std::move(done);
}

void Children::finish() {
  while (std::ranges::any_of(places_, [](const Place& place) { return place.process != 0; })) endOne();
}

// Waits until something has come from a call, or one has ended.
void Children::endOne() {
  std::vector<pollfd> pipes;
  for (const Place& place : places_) pipes.push_back({.fd = place.pipe, .events = POLLIN, .revents = 0});
  if (poll(pipes.data(), pipes.size(), -1) < 0 && errno != EINTR) {
    throw Failure(fmt::format("no answer of a process can be read: {}", std::strerror(errno)));
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (pipes[i].revents != 0) read(places_[i]);
  }
}

void Children::read(Place& place) {
  char buffer[4096];
  const auto bytes = ::read(place.pipe, buffer, sizeof buffer);
  if (bytes < 0 && errno == EINTR) return;
  if (bytes > 0) {
    place.message.append(buffer, static_cast<std::size_t>(bytes));
    return;
  }
  close(std::exchange(place.pipe, -1));  // poll leaves out negative descriptors
  const int status = statusOf(std::exchange(place.process, 0));
  const bool answered = WIFEXITED(status) && WEXITSTATUS(status) == 0 && !place.message.empty();
  const Done done = std::exchange(place.done, {});
  done(answered ? answerIn(place.message) : Answer{{}, endText(status)});
}

}  // namespace irk::cores
