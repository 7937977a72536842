#include "experiments/base/file_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "experiments/base/failure.h"

namespace irk {
namespace {

struct flock wholeFile(short type) {
  struct flock whole = {};
  whole.l_type = type;
  whole.l_whence = SEEK_SET;
  return whole;
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& file)
    : descriptor_(open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) throw Failure(fmt::format("cannot open {}: {}", file.string(), std::strerror(errno)));
}

FileLock::~FileLock() { close(descriptor_); }

FileLock::State FileLock::take() {
  const struct flock lock = wholeFile(F_WRLCK);
  if (fcntl(descriptor_, F_OFD_SETLK, &lock) == 0) return State::kTaken;
  return errno == EAGAIN || errno == EACCES ? State::kBusy : State::kNone;
}

bool isLocked(const std::filesystem::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct flock lock = wholeFile(F_RDLCK);
  const bool is_locked = fcntl(descriptor, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  close(descriptor);
  return is_locked;
}

}  // namespace irk
