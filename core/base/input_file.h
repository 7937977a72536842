// Reads whole files that a user names, up to a size limit.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace irk {

/// Largest study or tableau file, in bytes. A tableau of 100 stages with 80 digits has 1 MB.
inline constexpr std::size_t kMaxInputBytes = std::size_t{8} << 20U;
/// Largest table, in bytes.
inline constexpr std::size_t kMaxTableBytes = std::size_t{8} << 30U;

/// Returns the whole content of a regular file (or of a link to one). Throws Misuse for a path that does not exist,
/// for a folder, a device or a pipe, for a file that cannot be read, and for one of more than `most` bytes. The
/// message names the path, what was found and what is allowed.
std::string readInputFile(const std::filesystem::path& path, std::size_t most = kMaxInputBytes);

/// Throws Misuse if the path exists but is no regular file (nor a link to one).
void requireRegularFile(const std::filesystem::path& path);

}  // namespace irk
