// Lists of scenes in the blocks of a study.
#pragma once

#include "experiments/study/study_file.h"

namespace irk {

/// Replaces `@ivp` among the scenes of a block by the scenes of this collection; a scene of two collections is taken
/// once. Throws Misuse with the place for an unknown collection.
void expandCollections(StudyKeys& keys);

}  // namespace irk
