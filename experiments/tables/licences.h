// The parts of other authors that this program contains, with their licences.
#pragma once

#include <string>

namespace irk {

/// Version and commit in the first line, then the program's licence and those of its parts.
std::string versionText();

}  // namespace irk
