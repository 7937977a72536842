#include "core/base/input_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "irk/misuse.h"

namespace irk {
namespace {

const char* nameOf(std::filesystem::file_type type) {
  switch (type) {
    case std::filesystem::file_type::directory:
      return "a folder";
    case std::filesystem::file_type::fifo:
      return "a pipe";
    case std::filesystem::file_type::character:
    case std::filesystem::file_type::block:
      return "a device";
    case std::filesystem::file_type::socket:
      return "a socket";
    default:
      return "of an unknown kind";
  }
}

}  // namespace

// Only regular files are read: devices and pipes may have no end, and opening a pipe waits for its writer.
void requireRegularFile(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw Misuse("'" + path.string() + "' is " + nameOf(status.type()) + ": a regular file is expected");
  }
}

std::string readInputFile(const std::filesystem::path& path, std::size_t most) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw Misuse("file '" + path.string() + "' cannot be read: " + (error ? error.message() : std::strerror(ENOENT)));
  }
  requireRegularFile(path);
  const auto tooLong = [&] {
    throw Misuse("file '" + path.string() + "' is too long: up to " + std::to_string(most) + " bytes are read");
  };
  const auto size = std::filesystem::file_size(path, error);
  if (!error && size > most) tooLong();
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  const auto refuse = [&] {
    const char* reason = errno != 0 ? std::strerror(errno) : "reading failed";
    throw Misuse("file '" + path.string() + "' cannot be read: " + reason);
  };
  if (!in) refuse();
  std::string text;
  constexpr std::size_t kBlock = std::size_t{1} << 16U;
  // Files in /proc report no size, and a file may grow. The bytes are therefore counted again while reading.
  if (!error) text.reserve(static_cast<std::size_t>(size));
  for (std::streamsize got = 1; in && got > 0;) {
    const std::size_t had = text.size();
    text.resize(had + kBlock);
    in.read(text.data() + had, static_cast<std::streamsize>(kBlock));
    got = in.gcount();
    text.resize(had + static_cast<std::size_t>(got));
    if (text.size() > most) tooLong();
  }
  if (in.bad()) refuse();
  return text;
}

}  // namespace irk
