// What a study cannot ask for.
#pragma once

#include <cstddef>

#include "experiments/study_file.h"

namespace irk {

/// Throws Misuse `file:line: reason` where a series of the block, those of the study from `first` on, has
/// variable order and the study wants an analysis of one method: `scaling`, `estimates`, `phases`.
void refuseVariableOrder(const Study& study, const StudyKeys& block, std::size_t first);

}  // namespace irk
