// The folder in which the program keeps what it can make again: compiled scenes, computed references.
#pragma once

#include <filesystem>
#include <string_view>

namespace irk {

/// The folder `part` of this user's cache: IRK_CACHE, else XDG_CACHE_HOME/irk, else HOME/.cache/irk; created if it is
/// missing. Throws Misuse if none of the three variables is set, and Failure if the folder cannot be made.
std::filesystem::path cacheFolder(std::string_view part);

}  // namespace irk
