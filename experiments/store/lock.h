// One writer per study: the file `lock` in the study's folder.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "experiments/base/file_lock.h"

namespace irk::store {

enum class IfLocked { kRefuse, kWait };

/// Holds the lock (FileLock) of `folder`/lock, where host, process and date of its holder stand. It keeps two writers
/// from doing the same work; rows are safe without it, because no two processes write to the same file.
class Lock {
 public:
  /// If another process holds the lock: throws Failure, or with kWait waits until it is free or for an interrupt. A
  /// file system without locks is said on `messages`.
  Lock(const std::filesystem::path& folder, IfLocked if_locked, std::ostream& messages);
  ~Lock();
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  std::filesystem::path file_;
  FileLock lock_;
};

/// `process 4711 on HOST writes there since DATE`; empty if no process holds the folder's lock.
std::string writerIn(const std::filesystem::path& folder);

}  // namespace irk::store
