// Files of numbers that a scene of your own reads: a load, a profile of a road.
//
//   #include <irk/data_files.h>
//   IRK_DATA_FILES("load.dat")                                  // once, outside of namespaces
//   ...
//   std::ifstream load(irk::dataFile("load.dat", __FILE__));    // in the scene's functions
//
// Their contents become part of the scene: runs and references that were made with other contents are not taken for
// those of the new ones.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// Names relative to the folder of the scene's file.
#define IRK_DATA_FILES(...)                                                               \
  extern "C" __attribute__((visibility("default"))) const char* const* irk_data_files() { \
    static const char* const files[] = {__VA_ARGS__, nullptr};                            \
    return files;                                                                         \
  }

namespace irk {

/// The path of a file beside the scene's file, whatever the working folder is. `scene` is __FILE__.
inline std::string dataFile(std::string_view name, std::string_view scene) {
  return (std::filesystem::path(scene).parent_path() / name).string();
}

}  // namespace irk
