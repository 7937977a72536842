// Where and when numbers were made: the head of every table.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/table.h"

namespace irk {

/// study, version, commit, compiler, flags, cpu, threads, date.
TableHead environmentHead(const std::string& study, int threads);

/// Now, UTC, ISO 8601.
std::string dateText();

/// The folder with plots/: IRK_HOME, else the sources this was built from, else a folder above the program; never
/// the working folder, whose scripts anybody may have written. Throws Misuse if there is none.
std::filesystem::path homeFolder();

}  // namespace irk
