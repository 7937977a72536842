#include "experiments/own/shared_library.h"

#include <cxxabi.h>

#include <cstdlib>
#include <memory>

// Without Boost.Filesystem, which would have to be linked.
#define BOOST_DLL_USE_STD_FS
#include <boost/dll/shared_library.hpp>

#include "core/base/input_file.h"
#include "experiments/base/numbers.h"
#include "irk/misuse.h"

namespace irk {
namespace {

using Library = boost::dll::shared_library;

// `FILE: undefined symbol: _Z5tabled` becomes `undefined symbol: table(double)`.
std::string withoutMangling(const std::string& reason) {
  const std::string kind = "undefined symbol: ";
  const auto at = reason.find(kind);
  if (at == reason.npos) return reason;
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> symbol(
      abi::__cxa_demangle(reason.c_str() + at + kind.size(), nullptr, nullptr, &status), std::free);
  return status == 0 ? kind + symbol.get() : reason.substr(at);
}

// The reason of the system's loader, without the text that Boost adds: `... (dlerror system message: REASON): ...`.
std::string reasonOf(const std::string& text) {
  const std::string before = "dlerror system message: ";
  const auto begin = text.find(before), end = text.rfind("): ");
  if (begin == text.npos || end == text.npos || end < begin) return text;
  return "it cannot be loaded: " + withoutMangling(text.substr(begin + before.size(), end - begin - before.size()));
}

constexpr std::size_t kMaxLibraryBytes = std::size_t{1} << 30U;

}  // namespace

SharedLibrary::SharedLibrary(const std::filesystem::path& path) : path_(path) {
  hash_ = hexText(fnv1a(readInputFile(path, kMaxLibraryBytes)));
  try {
    // Without a folder the loader would search the system's libraries.
    library_ = std::make_shared<Library>(std::filesystem::absolute(path), boost::dll::load_mode::rtld_now);
  } catch (const std::exception& error) {
    refuse(reasonOf(error.what()));
  }
}

void* SharedLibrary::address(const char* name) const {
  const auto& library = *static_cast<const Library*>(library_.get());
  return library.has(name) ? reinterpret_cast<void*>(&library.get<void()>(name)) : nullptr;
}

void SharedLibrary::refuse(const std::string& reason) const { throw Misuse(path_.string() + ": " + reason); }

}  // namespace irk
