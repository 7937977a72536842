// The cache of compiled files. Its objects run with the user's rights: only what this user has written is taken.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/file_lock.h"

namespace irk::own {

/// The folder `compiled` of the user's cache. Throws Misuse, naming the folder, if it belongs to another user or can be
/// written by others: they could put code there.
std::filesystem::path compiledFolder();

/// The hash of the contents of files, in their order. Throws Misuse if one cannot be read.
std::string hashOfFiles(const std::vector<std::filesystem::path>& files);

/// An object in the cache, and the record beside it: what it was made of, and the hash of its own bytes.
class CachedObject {
 public:
  /// `name` tells apart everything that an object depends on besides its files.
  CachedObject(const std::filesystem::path& folder, const std::string& name);

  const std::filesystem::path& object() const { return object_; }
  /// A name beside the object that no other process uses, on this or another host.
  std::filesystem::path nameBeside() const;

  enum class State { kMissing, kCurrent, kDamaged };
  /// kCurrent: the object is as it was written, by this user, and its files have not changed since. kDamaged: the files
  /// are the same, the object is not. `hash` becomes that of the files.
  State look(std::string& hash) const;

  /// Moves `made` to the object's place and writes the record.
  void put(const std::filesystem::path& made, const std::vector<std::filesystem::path>& files) const;

  /// Keeps the compiler's messages of a failure for processes that have waited for this one. The next one that has not
  /// compiles again, because other things than its files may have been mended.
  void putFailure(const std::string& messages) const;
  void forgetFailure() const;
  std::optional<std::string> failure() const;

 private:
  std::filesystem::path object_, record_, failed_;
  friend class CompileLock;
};

/// Only one process compiles a file at a time. Where the file system has no locks (FileLock), several may compile, each
/// to a file of its own.
class CompileLock {
 public:
  /// Waits, with a line on `log`, until no other process holds it or until an interrupt.
  CompileLock(const CachedObject& object, const std::string& source, std::ostream& log);
  bool waited() const { return waited_; }

 private:
  FileLock lock_;
  bool waited_ = false;
};

}  // namespace irk::own
