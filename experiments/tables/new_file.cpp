#include "experiments/tables/new_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ios>
#include <system_error>
#include <utility>

#include "core/base/input_file.h"
#include "experiments/base/failure.h"
#include "experiments/tables/environment.h"

namespace irk {

namespace {

[[noreturn]] void cannotWriteNew(const std::filesystem::path& file) {
  throw Failure(fmt::format("cannot write {}: {}", file.string(), std::strerror(errno)));
}

}  // namespace

std::filesystem::path newBeside(const std::filesystem::path& file) {
  requireRegularFile(file);
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  for (int i = 1;; ++i) {
    const std::filesystem::path beside = fmt::format("{}.{}.{}.{}.new", file.string(), hostName(), getpid(), i);
    const int descriptor = open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno != EEXIST) cannotWriteNew(beside);
    if (descriptor < 0) continue;
    ::close(descriptor);
    return beside;
  }
}

NewFile::NewFile(std::filesystem::path file)
    : file_(std::move(file)), beside_(newBeside(file_)), out_(beside_, std::ios::binary) {}

NewFile::~NewFile() {
  if (!out_.is_open()) return;
  out_.close();
  std::error_code none;
  std::filesystem::remove(beside_, none);
}

void NewFile::check() {
  if (!out_) cannotWriteNew(beside_);
}

void NewFile::close() {
  out_.flush();
  check();
  out_.close();
  std::filesystem::rename(beside_, file_);
}

}  // namespace irk
