// Studies from TOML files.
#pragma once

#include <string>
#include <string_view>

#include "experiments/study/study.h"

namespace irk {

/// A built-in study's id or the path of a TOML file. Throws Misuse with file, line, key and what is allowed, and for a
/// file with another study whose name is a built-in one's, or that of a folder of results: they would share a folder.
Study loadStudy(std::string_view id_or_file, StudyVariant variant);

/// From TOML text; `file` names it in messages.
Study parseStudy(std::string_view toml, const std::string& file, StudyVariant variant);

}  // namespace irk
