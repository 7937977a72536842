// TOML text of a user's file.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace irk {

/// Parses TOML without braces, times and lists of lists. Throws Misuse with file and line for other text.
toml::table parseToml(std::string_view text, const std::string& file);

}  // namespace irk
