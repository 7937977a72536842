// Checks paths that become part of gnuplot commands.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace irk {

/// Throws Misuse, naming `option`, for a path with quotes, backslashes, dollar signs or control characters: gnuplot,
/// or the shell that its scripts call, would interpret them.
void requirePlainPath(std::string_view option, const std::string& path);

/// The figure's path without .svg or .png. Throws Misuse, naming `option`, if it has no file name or its folder does
/// not exist, and Failure if no file can be written there.
std::filesystem::path figurePath(std::string_view option, const std::string& path);

}  // namespace irk
