// Takes the place of the other files of this folder where libzip and pugixml are missing.
#include "experiments/own/fmu/scene.h"
#include "irk/misuse.h"

namespace irk::own {

LibraryScene sceneOfFmu(const std::filesystem::path& fmu) {
  throw Misuse(
      fmu.string() +
      ": this program was built without libzip and pugixml, which read FMUs: install them (Debian: libzip-dev, "
      "libpugixml-dev), remove build/release/CMakeCache.txt and build it again");
}

}  // namespace irk::own
