// TOML text of a user's file.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace irk {

/// Throws Misuse with file and line for text that is no TOML, and for keys of more than 1000 parts.
toml::table parseToml(std::string_view text, const std::string& file);

}  // namespace irk
