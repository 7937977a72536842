// Version, commit, sources and compiler of this program; generated at build time by build_info.cmake.
#pragma once

#include <string_view>

namespace irk {

struct BuildInfo {
  std::string_view version;   ///< of the project
  std::string_view commit;    ///< git describe --always --dirty; `unknown` outside a repository
  std::string_view code;      ///< fingerprint of the sources that determine the numbers of a run
  std::string_view compiler;  ///< id and version
  std::string_view flags;
  std::string_view source_dir;
  std::string_view data_dir;  ///< of an installed program, relative to the program's folder: `../share/irk`
};

const BuildInfo& buildInfo();

}  // namespace irk
