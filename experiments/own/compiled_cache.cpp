#include "experiments/own/compiled_cache.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <ostream>
#include <thread>

#include "core/base/input_file.h"
#include "experiments/base/failure.h"
#include "experiments/base/folders.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/numbers.h"
#include "experiments/tables/environment.h"
#include "experiments/tables/new_file.h"
#include "irk/misuse.h"

namespace irk::own {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxObjectBytes = std::size_t{1} << 30U;

bool isWrittenByOthers(const struct stat& status) { return (status.st_mode & (S_IWGRP | S_IWOTH)) != 0; }

// A regular file that nobody but this user can have written.
bool isOwnFile(const fs::path& file) {
  struct stat status {};
  return lstat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == geteuid() &&
         !isWrittenByOthers(status);
}

// The record beside an object: the hash of the files that it was made of, that of the object, then the files' names,
// one a line.
struct ObjectRecord {
  std::string files_hash, object_hash;
  std::vector<fs::path> files;
};

ObjectRecord readRecord(const fs::path& path) {
  ObjectRecord record;
  if (!isOwnFile(path)) return record;
  std::ifstream in(path);
  std::getline(in, record.files_hash);
  std::getline(in, record.object_hash);
  for (std::string line; std::getline(in, line);) record.files.emplace_back(line);
  return record;
}

std::string hashNow(const std::vector<fs::path>& files) {
  try {
    return files.empty() ? "" : hashOfFiles(files);
  } catch (const std::exception&) {
    return "";  // an included file is gone
  }
}

std::string hashOfObject(const fs::path& object) { return hexText(fnv1a(readInputFile(object, kMaxObjectBytes))); }

// Nobody but the user may write it (isOwnFile), whatever the umask is.
void writeOwnFile(const fs::path& path, const std::string& text) {
  NewFile file(path);
  file.out() << text;
  file.close();
  chmod(path.c_str(), S_IRUSR | S_IWUSR);
}

}  // namespace

fs::path compiledFolder() {
  const fs::path folder = cacheFolder("compiled");
  struct stat status {};
  if (stat(folder.c_str(), &status) != 0) throw Failure("the cache folder " + folder.string() + " cannot be read");
  const bool is_own = status.st_uid == geteuid();
  if (is_own && !isWrittenByOthers(status)) return folder;
  throw Misuse(fmt::format(
      "the cache folder {} {}: what is there is run with your rights. {}set IRK_CACHE to a folder of your own",
      folder.string(), is_own ? "can be written by others" : fmt::format("belongs to user {}", status.st_uid),
      is_own ? "Remove it and make it again with mode 700, or " : ""));
}

std::string hashOfFiles(const std::vector<fs::path>& files) {
  std::string text;
  for (const auto& file : files) text += readInputFile(file.string()) + '\0';
  return hexText(fnv1a(text));
}

CachedObject::CachedObject(const fs::path& folder, const std::string& name)
    : object_(folder / (name + ".so")), record_(folder / (name + ".files")), failed_(folder / (name + ".failed")) {}

fs::path CachedObject::nameBeside() const { return fmt::format("{}.{}.{}", object_.string(), hostName(), getpid()); }

CachedObject::State CachedObject::look(std::string& hash) const {
  const ObjectRecord record = readRecord(record_);
  hash = hashNow(record.files);
  if (hash.empty() || hash != record.files_hash) return State::kMissing;
  std::error_code none;
  if (!fs::exists(object_, none)) return State::kMissing;
  return isOwnFile(object_) && hashOfObject(object_) == record.object_hash ? State::kCurrent : State::kDamaged;
}

void CachedObject::put(const fs::path& made, const std::vector<fs::path>& files) const {
  std::string text = hashOfFiles(files) + '\n' + hashOfObject(made) + '\n';
  for (const auto& file : files) text += file.string() + '\n';
  chmod(made.c_str(), S_IRWXU);
  fs::rename(made, object_);
  writeOwnFile(record_, text);
}

void CachedObject::putFailure(const std::string& messages) const { writeOwnFile(failed_, messages); }

void CachedObject::forgetFailure() const {
  std::error_code none;
  fs::remove(failed_, none);
}

std::optional<std::string> CachedObject::failure() const {
  if (!isOwnFile(failed_)) return {};
  std::ifstream in(failed_);
  return std::string{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

CompileLock::CompileLock(const CachedObject& object, const std::string& source, std::ostream& log)
    : lock_(fs::path(object.object_).replace_extension(".lock")) {
  constexpr auto kNap = std::chrono::milliseconds(20);
  while (lock_.take() == FileLock::State::kBusy) {
    if (!waited_) {
      fmt::print(log, "irk: waiting for another process that compiles {}\n", source);
      log.flush();
    }
    waited_ = true;
    if (interruptFlag()) throw Failure("interrupted while another process compiles " + source);
    std::this_thread::sleep_for(kNap);
  }
}

}  // namespace irk::own
