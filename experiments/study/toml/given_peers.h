// Integrators of the user's that take part in a study whose file does not name them.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/study_file.h"

namespace irk {

/// Adds each of `given`, a text as loadMethod takes it, to the methods of the blocks in which the program's integrator
/// for the same equations runs: that of `ida_bdf` if it solves index 2 and above, else that of `cvode_bdf`. Throws
/// Misuse for a text that is no integrator of another library, for one that is given twice, and if no block has its
/// like.
void addPeers(const std::vector<std::string>& given, StudyFile& study);

}  // namespace irk
