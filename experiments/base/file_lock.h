// A lock that ends with its holder.
#pragma once

#include <filesystem>

namespace irk {

/// The lock of a file, which one object at a time holds, in this process or another. The system frees it when its
/// process ends, however that happens (man 2 fcntl, F_OFD_SETLK). Whether processes on several hosts see each other's
/// locks depends on the file system: on NFS they do. Not thread-safe.
class FileLock {
 public:
  /// Makes the file if it is missing. Does not lock it. Follows no link. Throws Failure if the file cannot be opened.
  explicit FileLock(const std::filesystem::path& file);
  /// Frees the lock; the file stays.
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// kNone: the file system has no locks.
  enum class State { kTaken, kBusy, kNone };
  /// Locks the file unless it is locked.
  [[nodiscard]] State take();

 private:
  int descriptor_;
};

/// Whether the file is locked. Changes nothing, and makes no file.
bool isLocked(const std::filesystem::path& file);

}  // namespace irk
