// The files of an FMU, unpacked in the user's cache.
#pragma once

#include <filesystem>
#include <string>

namespace irk::own {

struct Unpacked {
  std::filesystem::path folder;
  std::string hash;  ///< of the archive
};

/// Unpacks an FMU, a zip archive, unless it was unpacked before; two processes may do it at the same time. Throws
/// Misuse for a file that is missing or no archive, and for names of files that lead out of the folder; Failure where
/// the cache cannot be written. Messages begin with the name of the file.
Unpacked unpack(const std::filesystem::path& fmu);

}  // namespace irk::own
