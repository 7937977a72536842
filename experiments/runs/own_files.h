// The users' files that a run needs, and how a command names them.
#pragma once

#include <string>
#include <string_view>

#include "experiments/runs/run_spec.h"

namespace irk {

/// Loads a file given by `--load`: PATH.cpp, PATH.so or CODE@PATH.so (loadMethod). Throws Misuse.
void loadOwn(const std::string& file);

/// The files of the spec's scene, strategies and method, with absolute paths, separated by ':': each as loadOwn takes
/// it, or the file of a tableau. Empty for a run that needs only parts of the program.
std::string filesOf(const RunSpec& spec);

/// `code of scene.cpp`, or `code of scene.cpp or newton.cpp`: of which an exception or a crash may come. Empty for a
/// run that needs only parts of the program.
std::string codeOf(const RunSpec& spec);

/// Parts of a command `irk solve`, from the text of filesOf: ` --load FILE` for each file to load, and the method,
/// which for a tableau file is its absolute path.
std::string loadOptions(std::string_view files);
std::string methodIn(std::string_view files, const std::string& method);

}  // namespace irk
