#include "experiments/base/folders.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "experiments/base/failure.h"
#include "irk/misuse.h"

namespace irk {
namespace {

std::filesystem::path userCache() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::filesystem::path(value ? value : "");
  };
  if (const auto own = variable("IRK_CACHE"); !own.empty()) return own;
  if (const auto cache = variable("XDG_CACHE_HOME"); !cache.empty()) return cache / "irk";
  if (const auto home = variable("HOME"); !home.empty()) return home / ".cache" / "irk";
  throw Misuse("no folder for the cache: set IRK_CACHE, XDG_CACHE_HOME or HOME");
}

}  // namespace

std::filesystem::path cacheFolder(std::string_view part) {
  const auto folder = userCache() / part;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Failure("the cache folder " + folder.string() + " cannot be made: " + error.message());
  return folder;
}

ScratchFolder::ScratchFolder() {
  std::string name = std::filesystem::temp_directory_path() / "irk_XXXXXX";
  if (!mkdtemp(name.data())) throw Failure("no temporary folder " + name + ": " + std::strerror(errno));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace irk
