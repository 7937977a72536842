// One writer per study: the file `lock` in the study's folder.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace irk::store {

enum class IfLocked { kRefuse, kWait };

/// Holds `folder`/lock, a file that only one process can create (O_EXCL, also over NFS). It contains host, process
/// and date of its holder, and when the process started, which tells it from a later one of the same number. The lock
/// keeps two writers from doing the same work; rows are safe without it, because no two processes write to the same
/// file.
class Lock {
 public:
  /// If another process holds the lock: throws Failure, or with kWait waits until it is free or for an interrupt.
  /// Takes over the lock of a process of this host that has ended, and one that has remained empty, with a line on
  /// `messages`. Whether a process of another host has ended is not known: its lock must be removed by hand.
  Lock(const std::filesystem::path& folder, IfLocked if_locked, std::ostream& messages);
  ~Lock();
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  bool create();
  std::filesystem::path file_;
  std::string text_;
};

}  // namespace irk::store
