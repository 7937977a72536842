#include "experiments/store/lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ostream.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <ostream>
#include <sstream>
#include <thread>
#include <tuple>

#include "core/base/input_file.h"
#include "experiments/base/failure.h"
#include "experiments/base/interrupt.h"
#include "experiments/tables/environment.h"

namespace irk::store {
namespace {

constexpr auto kPause = std::chrono::milliseconds(100);

/// What /proc knows of a process.
struct ProcessState {
  char state = '?';
  std::string start = "unknown";  ///< in ticks of the machine
};

// Line `pid (name) state ...` with the start as cell 22; the name may contain anything.
ProcessState stateOf(long process) {
  std::ifstream in(fmt::format("/proc/{}/stat", process));
  const std::string line{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const auto name_end = line.rfind(')');
  ProcessState found;
  if (name_end == line.npos) return found;
  constexpr int kBetween = 18;  // cells
  std::istringstream cells(line.substr(name_end + 1));
  std::string skipped, start;
  cells >> found.state;
  for (int i = 0; i < kBetween; ++i) cells >> skipped;
  if (cells >> start) found.start = start;
  return found;
}

struct Holder {
  std::string host = "unknown", date = "unknown", start = "unknown";
  long process = 0;  ///< 0: unknown
  std::string text;  ///< of the file

  // Whether it was a process of this machine that has ended: its parent may not have asked for its status yet, and its
  // number may be that of another process now.
  bool isDead() const {
    if (process <= 0 || host != hostName()) return false;
    if (kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH) return true;
    const ProcessState now = stateOf(process);
    const bool is_another = start != "unknown" && now.start != "unknown" && start != now.start;
    return now.state == 'Z' || now.state == 'X' || is_another;
  }
};

Holder readHolder(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  Holder holder;
  holder.text = {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  std::istringstream words(holder.text);
  Holder read;
  if (!(words >> read.host >> read.process >> read.date >> read.start)) return holder;
  read.text = holder.text;
  return read;
}

// Renaming is atomic: if two processes find a lock whose holder has ended, only one gets it. If the lock that it gets
// turns out to be a new one, it puts that back.
bool removeDead(const std::filesystem::path& file, const Holder& dead) {
  const std::filesystem::path aside = file.string() + fmt::format(".of_dead.{}.{}", hostName(), getpid());
  if (rename(file.c_str(), aside.c_str()) != 0) return false;
  const bool is_dead = readHolder(aside).text == dead.text;
  if (!is_dead) std::ignore = link(aside.c_str(), file.c_str());
  unlink(aside.c_str());
  return is_dead;
}

}  // namespace

bool Lock::create() {
  const int file = open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0 && errno == EEXIST) return false;
  const bool written = file >= 0 && write(file, text_.data(), text_.size()) == static_cast<ssize_t>(text_.size());
  if (!written) {
    const int error = errno;
    if (file >= 0) unlink(file_.c_str());
    if (file >= 0) close(file);
    throw Failure(fmt::format("cannot write {}: {}", file_.string(), std::strerror(error)));
  }
  close(file);
  return true;
}

Lock::Lock(const std::filesystem::path& folder, IfLocked if_locked, std::ostream& messages)
    : file_(folder / "lock"),
      text_(fmt::format("{} {} {} {}\n", hostName(), getpid(), dateText(), stateOf(getpid()).start)) {
  std::filesystem::create_directories(folder);
  bool told = false;
  int unknown_for = 0;  // attempts
  while (!create()) {
    requireRegularFile(file_);
    const Holder holder = readHolder(file_);
    // A lock file is empty for a moment, before its holder has written to it, or it has just been removed. It remains
    // empty if its holder was killed in this moment.
    constexpr int kEmptyAttempts = 10;
    unknown_for = holder.process == 0 ? unknown_for + 1 : 0;
    const bool unknown = holder.process == 0 && unknown_for <= kEmptyAttempts;
    if (unknown_for > kEmptyAttempts && holder.text.empty()) {
      unknown_for = 0;
      if (removeDead(file_, holder)) {
        fmt::print(messages, "{}: its lock is empty: its holder was killed; going on in its place\n", folder.string());
      }
      continue;
    }
    if (holder.isDead()) {
      if (!removeDead(file_, holder)) continue;
      fmt::print(messages,
                 "{}: process {} of this machine, which wrote here since {}, is no more: going on in its place\n",
                 folder.string(), holder.process, holder.date);
      continue;
    }
    const auto who = fmt::format("process {} on {} writes there since {}", holder.process, holder.host, holder.date);
    if (if_locked == IfLocked::kRefuse && !unknown) {
      throw Failure(fmt::format("{}: {}; --wait waits for its end. If it is no more, remove {}", folder.string(), who,
                                file_.string()));
    }
    if (interruptFlag()) throw Failure(fmt::format("{}: interrupted while {}", folder.string(), who));
    if (!told && !unknown) fmt::print(messages, "{}: {}: waiting\n", folder.string(), who);
    told = told || !unknown;
    std::this_thread::sleep_for(kPause);
  }
}

Lock::~Lock() {
  if (readHolder(file_).text == text_) unlink(file_.c_str());
}

}  // namespace irk::store
