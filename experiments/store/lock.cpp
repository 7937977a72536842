#include "experiments/store/lock.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <ostream>
#include <thread>

#include "core/base/input_file.h"
#include "experiments/base/failure.h"
#include "experiments/base/interrupt.h"
#include "experiments/tables/environment.h"

namespace irk::store {
namespace {

std::filesystem::path lockFileIn(const std::filesystem::path& folder) {
  auto file = folder / "lock";
  requireRegularFile(file);
  return file;
}

std::filesystem::path newLockFileIn(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  return lockFileIn(folder);
}

std::string writerNamedIn(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string host, process, date;
  if (!(in >> host >> process >> date)) return "another process writes there";
  return fmt::format("process {} on {} writes there since {}", process, host, date);
}

}  // namespace

Lock::Lock(const std::filesystem::path& folder, IfLocked if_locked, std::ostream& messages)
    : file_(newLockFileIn(folder)), lock_(file_) {
  constexpr auto kPause = std::chrono::milliseconds(100);
  auto state = lock_.take();
  for (bool told = false; state == FileLock::State::kBusy; state = lock_.take()) {
    const auto who = fmt::format("{}: {}", folder.string(), writerNamedIn(file_));
    if (if_locked == IfLocked::kRefuse) throw Failure(who + "; --wait waits for its end");
    if (interruptFlag()) throw Failure(who + "; interrupted while waiting for its end");
    if (!told) fmt::print(messages, "{}: waiting\n", who);
    told = true;
    std::this_thread::sleep_for(kPause);
  }
  std::ofstream out(file_);
  if (!(out << hostName() << ' ' << getpid() << ' ' << dateText() << '\n').flush()) {
    throw Failure(fmt::format("cannot write {}", file_.string()));
  }
  if (state == FileLock::State::kNone) {
    fmt::print(messages, "{}: this file system has no locks; a second process that writes there is not told\n",
               folder.string());
  }
}

Lock::~Lock() {
  std::error_code none;
  std::filesystem::resize_file(file_, 0, none);
}

std::string writerIn(const std::filesystem::path& folder) {
  const auto file = lockFileIn(folder);
  return isLocked(file) ? writerNamedIn(file) : "";
}

}  // namespace irk::store
