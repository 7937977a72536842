// Files of the user's own in a study: its key `load`, and scenes and methods that are named by a file.
#pragma once

#include <string>

#include "experiments/study/study_file.h"

namespace irk {

/// Loads the files of the key `load`, and makes names of .cpp files, which are relative to the study's file, relative
/// to the working folder. Throws Misuse with `file:line`.
void loadOwnFiles(StudyFile& study, const std::string& study_file);

}  // namespace irk
