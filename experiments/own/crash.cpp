#include "experiments/own/crash.h"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

namespace irk::own {
namespace {

// Made before a crash: a handler may not allocate.
std::string& message() {
  static auto& text = *new std::string;
  return text;
}

void onCrash(int) {
  const auto written = write(STDERR_FILENO, message().data(), message().size());
  _exit(written < 0 ? 2 : 1);
}

// A stack of its own: the crash may be that the stack is used up.
void useOwnStack() {
  static auto& memory = *new std::vector<char>(static_cast<std::size_t>(4 * SIGSTKSZ));
  const stack_t stack{.ss_sp = memory.data(), .ss_flags = 0, .ss_size = memory.size()};
  sigaltstack(&stack, nullptr);
}

}  // namespace

void explainCrashes(const std::filesystem::path& file) {
  const bool is_source = file.extension() == ".cpp";
  message() = "irk: the program crashed while it ran code of " + file.string() + ", most likely by " +
              (is_source ? "an index out of range" : "another calling sequence or an index out of range") +
              "; what was finished before is kept";
  message() +=
      is_source && !wantsChecks() ? "; compiled with checks it tells the place: IRK_CHECKED=1 irk ...\n" : ".\n";
  static const bool installed = [] {
    useOwnStack();
    struct sigaction action = {};
    action.sa_handler = onCrash;
    action.sa_flags = SA_ONSTACK;
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT}) sigaction(signal, &action, nullptr);
    return true;
  }();
  static_cast<void>(installed);
}

bool wantsChecks() {
  const char* const value = std::getenv("IRK_CHECKED");
  return value && *value && std::string(value) != "0";
}

}  // namespace irk::own
