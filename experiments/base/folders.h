// Folders for files of the program: the user's cache, and temporary ones.
#pragma once

#include <filesystem>
#include <string_view>

namespace irk {

/// The folder in which the program keeps what it can make again: `part` (compiled scenes, computed references) of this
/// user's cache: IRK_CACHE, else XDG_CACHE_HOME/irk, else HOME/.cache/irk; created if it is missing. Throws Misuse if
/// none of the three variables is set, and Failure if the folder cannot be made.
std::filesystem::path cacheFolder(std::string_view part);

/// A new folder inside the system's temporary one (TMPDIR); the destructor removes it with its contents.
class ScratchFolder {
 public:
  /// Throws Failure if it cannot be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace irk
