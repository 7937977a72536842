// Data that would need too much memory: a file without a name, which vanishes with the process.
#pragma once

#include <cstddef>
#include <cstdint>

namespace irk::store {

/// A file in the folder of temporary files (TMPDIR). Reading and writing are thread-safe. Throws Failure, for example
/// if the disk is full.
class SpillFile {
 public:
  SpillFile();
  ~SpillFile();
  SpillFile(const SpillFile&) = delete;
  SpillFile& operator=(const SpillFile&) = delete;

  /// `offset` is in bytes.
  void write(const void* bytes, std::size_t size, std::uint64_t offset);
  void read(void* bytes, std::size_t size, std::uint64_t offset) const;

 private:
  int descriptor_;
};

}  // namespace irk::store
