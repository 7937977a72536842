// One writer per study: the file `lock` in the study's folder.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace irk::store {

enum class IfLocked { kRefuse, kWait };

/// Holds `folder`/lock, a file that only one process can create (O_EXCL, also over NFS), with host, process and date of
/// its holder. The lock saves work that two writers would do twice; rows are safe without it, as no two processes
/// write to one file.
class Lock {
 public:
  /// Throws Failure if another process holds it, or with kWait waits for its end, or for an interrupt. The lock
  /// of a process of this host that is no more is taken over, with a line on `messages`.
  Lock(std::filesystem::path folder, IfLocked if_locked, std::ostream& messages);
  ~Lock();
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  bool create();
  std::filesystem::path file_;
  std::string text_;
};

}  // namespace irk::store
