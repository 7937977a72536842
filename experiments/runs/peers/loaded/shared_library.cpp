#include "experiments/runs/peers/loaded/shared_library.h"

#include <dlfcn.h>

#include "core/base/input_file.h"
#include "experiments/base/numbers.h"
#include "irk/misuse.h"

namespace irk {
namespace {

constexpr std::size_t kMaxLibraryBytes = std::size_t{1} << 30U;

}  // namespace

void SharedLibrary::Close::operator()(void* handle) const { dlclose(handle); }

SharedLibrary::SharedLibrary(const std::filesystem::path& path) : path_(path) {
  hash_ = hexText(fnv1a(readInputFile(path, kMaxLibraryBytes)));
  // Without a folder the loader would search the system's libraries.
  handle_.reset(dlopen(std::filesystem::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL));
  if (!handle_) refuse(dlerror());
}

void* SharedLibrary::address(const char* name) const { return dlsym(handle_.get(), name); }

void SharedLibrary::refuse(const std::string& reason) const { throw Misuse(path_.string() + ": " + reason); }

}  // namespace irk
