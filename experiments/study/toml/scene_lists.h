// Lists of scenes in the blocks of a study.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/study_file.h"

namespace irk {

/// Replaces `@ivp` among scenes by the scenes of this collection; a scene of two collections is taken once. Throws
/// Misuse with the place for an unknown collection.
void expandCollections(StudyValue& scenes);

/// The ids of these scenes, after expandCollections; users' files are loaded. Throws Misuse with the place.
std::vector<std::string> sceneIds(StudyValue scenes);

}  // namespace irk
