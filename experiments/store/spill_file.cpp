#include "experiments/store/spill_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "experiments/base/failure.h"

namespace irk::store {
namespace {

[[noreturn]] void fail(const char* what) {
  throw Failure(fmt::format("temporary files in {} (TMPDIR): cannot {}: {}",
                            std::filesystem::temp_directory_path().string(), what, std::strerror(errno)));
}

}  // namespace

SpillFile::SpillFile() {
  std::string name = (std::filesystem::temp_directory_path() / "irk_XXXXXX").string();
  descriptor_ = mkostemp(name.data(), O_CLOEXEC);
  if (descriptor_ < 0) fail("create one");
  unlink(name.c_str());
}

SpillFile::~SpillFile() { close(descriptor_); }

void SpillFile::write(const void* bytes, std::size_t size, std::uint64_t offset) {
  for (const char* at = static_cast<const char*>(bytes); size > 0;) {
    const auto count = pwrite(descriptor_, at, size, static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("write one");
    at += count;
    offset += static_cast<std::uint64_t>(count);
    size -= static_cast<std::size_t>(count);
  }
}

void SpillFile::read(void* bytes, std::size_t size, std::uint64_t offset) const {
  for (char* at = static_cast<char*>(bytes); size > 0;) {
    const auto count = pread(descriptor_, at, size, static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count == 0) errno = EIO;
    if (count <= 0) fail("read one");
    at += count;
    offset += static_cast<std::uint64_t>(count);
    size -= static_cast<std::size_t>(count);
  }
}

}  // namespace irk::store
