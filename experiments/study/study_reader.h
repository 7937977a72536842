// Studies from TOML files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/study.h"

namespace irk {

/// Loads a built-in study by id, or a TOML file by path. Throws Misuse with file, line, key and allowed values; also
/// for a file that has the name of another built-in study or of a folder of results: they would share a folder.
/// `peers`: integrators that take part besides those that the study names (toml/given_peers.h).
Study loadStudy(std::string_view id_or_file, StudyVariant variant, const std::vector<std::string>& peers = {});

/// Parses TOML text; messages call it `file`.
Study parseStudy(std::string_view toml, const std::string& file, StudyVariant variant,
                 const std::vector<std::string>& peers = {});

}  // namespace irk
