// Files that a user names: read whole, within a limit.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace irk {

/// Bytes of the largest study or tableau that is read; a tableau of 100 stages with 80 digits has 1 MB.
inline constexpr std::size_t kMostInputBytes = std::size_t{8} << 20U;
/// And of the largest table.
inline constexpr std::size_t kMostTableBytes = std::size_t{8} << 30U;

/// The whole content of a regular file (or a link to one). Throws Misuse naming the path, what is there and
/// what is allowed: for a folder, a device, a pipe, a file that cannot be read, one of more than `most` bytes.
std::string readInputFile(const std::filesystem::path& path, std::size_t most = kMostInputBytes);

/// Throws Misuse as readInputFile for what is there and no regular file.
void requireRegularFile(const std::filesystem::path& path);

}  // namespace irk
