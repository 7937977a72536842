#include "experiments/own/crash.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "experiments/base/failure.h"
#include "experiments/own/fixed_text.h"
#include "experiments/own/stuck.h"

namespace irk::own {
namespace {

FixedText of_exit, of_any_file;
thread_local const FixedText* running = &of_any_file;  // what a crash of this thread prints

void onCrash(int) {
  running->print();
  _exit(1);
}

std::atomic<bool> exit_is_mistake = false;

void onExit() {
  if (!exit_is_mistake) return;
  of_exit.print();
  _exit(1);
}

// A stack of its own: the crash may be that the stack is used up.
void useOwnStack() {
  static auto& memory = *new std::vector<char>(static_cast<std::size_t>(4 * SIGSTKSZ));
  const stack_t stack{.ss_sp = memory.data(), .ss_flags = 0, .ss_size = memory.size()};
  sigaltstack(&stack, nullptr);
}

}  // namespace

const FixedText* Running::messageOf(std::string_view code) {
  static std::mutex mutex;
  static auto& texts = *new std::map<std::string, std::unique_ptr<FixedText>, std::less<>>;
  if (code.empty()) return &of_any_file;
  const std::lock_guard lock(mutex);
  const auto known = texts.find(code);
  if (known != texts.end()) return known->second.get();
  const bool is_source = code.ends_with(".cpp");
  std::string crash =
      "irk: the program crashed while it ran " + std::string(code) + ", most likely by " +
      (is_source ? "an index out of range or a null pointer" : "another calling sequence or an index out of range") +
      "; what was finished before is kept";
  crash += is_source && !wantsChecks() ? "; compiled with checks it tells the place: IRK_CHECKED=1 irk ...\n" : ".\n";
  auto text = std::make_unique<FixedText>();
  text->set(crash);
  return texts.emplace(code, std::move(text)).first->second.get();
}

Running::Running(const FixedText* message) : before_(running) { running = message; }
Running::~Running() { running = before_; }

void explainCrashes(const std::filesystem::path& file) {
  constexpr int kSilentSeconds = 20;  // far more than a step needs, but in large systems with many digits
  static std::mutex mutex;            // a run in multiprecision compiles its scene anew
  const std::lock_guard lock(mutex);
  static std::set<std::string> given;
  static std::string files;
  if (given.insert(file.string()).second) files += (files.empty() ? "" : " or ") + file.string();
  blameExceptionsOn(files);
  askWhenStuck(files, kSilentSeconds);
  of_exit.set("irk: code of " + files + " called exit(); it has to return\n");
  of_any_file.set("irk: the program crashed; code of " + files +
                  " may have written outside its arrays before; what was finished before is kept\n");
  running = Running::messageOf("code of " + file.string());
  static const bool installed = [] {
    useOwnStack();
    struct sigaction action = {};
    action.sa_handler = onCrash;
    action.sa_flags = SA_ONSTACK;
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT}) sigaction(signal, &action, nullptr);
    std::atexit(onExit);
    return true;
  }();
  static_cast<void>(installed);
}

ExitGuard::ExitGuard() { exit_is_mistake = true; }
ExitGuard::~ExitGuard() { allowExit(); }
void allowExit() { exit_is_mistake = false; }

bool wantsChecks() {
  const char* const value = std::getenv("IRK_CHECKED");
  return value && *value && std::string(value) != "0";
}

}  // namespace irk::own
