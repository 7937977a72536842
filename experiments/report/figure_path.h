// Paths that become part of gnuplot's commands.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace irk {

/// Throws Misuse, naming `option`, for a path with quotes, backslashes, dollar signs or control characters: gnuplot and
/// the shell inside its scripts would read it as something else.
void requirePlainPath(std::string_view option, const std::string& path);

/// The figure's path without .svg or .png. Throws Misuse, naming `option`, where it names no file or its folder
/// does not exist.
std::filesystem::path figurePath(std::string_view option, const std::string& path);

}  // namespace irk
