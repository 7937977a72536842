// The users' files that a run needs: which they are, and how a command names them.
#pragma once

#include <string>
#include <string_view>

#include "experiments/runs/run_spec.h"

namespace irk {

/// Loads what `--load` names: PATH.cpp, PATH.so or CODE@PATH.so (loadMethod). Throws Misuse.
void loadOwn(const std::string& file);

/// The files of the spec's scene, strategies and method: as loadOwn takes them, and the file of a tableau; with
/// absolute paths, ':' between them. Empty for a run of the program's own parts.
std::string filesOf(const RunSpec& spec);

/// Parts of a command `irk solve`, from the text of filesOf: ` --load FILE` for each file to load, and the method,
/// which for a tableau file is its absolute path.
std::string loadOptions(std::string_view files);
std::string methodIn(std::string_view files, const std::string& method);

/// The text as one word of a shell's command, quoted where that is needed.
std::string shellWord(const std::string& text);

}  // namespace irk
