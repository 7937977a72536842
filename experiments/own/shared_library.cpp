#include "experiments/own/shared_library.h"

#include <cxxabi.h>
#include <elf.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

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

template <class Header>
Header headerAt(const std::string& bytes, std::size_t at) {
  Header header;
  std::memcpy(&header, bytes.data() + at, sizeof header);
  return header;
}

// The bytes that an ELF file must have by its own headers; 0 for another kind of file.
std::size_t bytesOfElf(const std::string& bytes) {
  if (!bytes.starts_with(std::string_view(ELFMAG, SELFMAG))) return 0;
  if (bytes.size() < sizeof(Elf64_Ehdr)) return sizeof(Elf64_Ehdr);
  const auto elf = headerAt<Elf64_Ehdr>(bytes, 0);
  if (elf.e_ident[EI_CLASS] != ELFCLASS64 || elf.e_phentsize != sizeof(Elf64_Phdr)) return 0;
  const std::size_t segments = elf.e_phoff + elf.e_phnum * sizeof(Elf64_Phdr);
  std::size_t needed = std::max(segments, elf.e_shoff + std::size_t{elf.e_shnum} * elf.e_shentsize);
  for (std::size_t at = elf.e_phoff; segments <= bytes.size() && at < segments; at += sizeof(Elf64_Phdr)) {
    const auto segment = headerAt<Elf64_Phdr>(bytes, at);
    if (segment.p_type == PT_LOAD) needed = std::max<std::size_t>(needed, segment.p_offset + segment.p_filesz);
  }
  return needed;
}

}  // namespace

SharedLibrary::SharedLibrary(const std::filesystem::path& path) : path_(path) {
  const std::string bytes = readInputFile(path, kMaxLibraryBytes);
  hash_ = hexText(fnv1a(bytes));
  const std::size_t needed = bytesOfElf(bytes);
  if (needed > bytes.size()) {  // the loader would crash
    refuse(fmt::format("it is cut short: it has {} bytes, by its own headers {}", bytes.size(), needed));
  }
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
