// Whose results a folder holds: two study files of one name would replace each other's tables.
#pragma once

#include <filesystem>

namespace irk {

/// Keeps the path of a user's study in FOLDER/study_file. Throws Misuse if that names another file that is still there
/// and differs from `study`.
void keepStudyFile(const std::filesystem::path& study, const std::filesystem::path& folder);

}  // namespace irk
