#include "experiments/own/fmu/archive.h"

#include <fmt/format.h>
#include <unistd.h>
#include <zip.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <string_view>
#include <vector>

#include "core/base/input_file.h"
#include "experiments/base/failure.h"
#include "experiments/base/folders.h"
#include "experiments/base/numbers.h"
#include "irk/misuse.h"

namespace irk::own {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{1} << 30U;

struct ZipCloser {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct ZipFileCloser {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using Archive = std::unique_ptr<zip_t, ZipCloser>;

// Of other platforms nothing is needed.
bool isWanted(std::string_view name) {
  if (name.ends_with('/')) return false;
  return name == "modelDescription.xml" || name.starts_with("resources/") || name.starts_with("sources/") ||
         name.starts_with("binaries/linux64/") || name.starts_with("binaries/x86_64-linux/");
}

void requireInsideFolder(const fs::path& fmu, const fs::path& name) {
  const bool leads_out = name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end();
  if (leads_out)
    throw Misuse(fmt::format("{}: the file '{}' in it leads out of its folder", fmu.string(), name.string()));
}

void writeEntry(const fs::path& fmu, zip_t* archive, zip_uint64_t number, const fs::path& to) {
  zip_stat_t about;
  const std::unique_ptr<zip_file_t, ZipFileCloser> file(zip_fopen_index(archive, number, 0));
  if (!file || zip_stat_index(archive, number, 0, &about) != 0 || about.size > kMaxBytes) {
    throw Misuse(
        fmt::format("{}: {} in it cannot be read: {}", fmu.string(), to.filename().string(), zip_strerror(archive)));
  }
  std::vector<char> bytes(about.size);
  std::size_t read = 0;
  while (read < bytes.size()) {
    const auto more = zip_fread(file.get(), bytes.data() + read, bytes.size() - read);
    if (more <= 0) throw Misuse(fmt::format("{}: {} in it is damaged", fmu.string(), to.filename().string()));
    read += static_cast<std::size_t>(more);
  }
  fs::create_directories(to.parent_path());
  std::ofstream out(to, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out.flush()) throw Failure(fmt::format("{}: it cannot be written", to.string()));
}

void unpackTo(const fs::path& fmu, const fs::path& folder) {
  int code = 0;
  const Archive archive(zip_open(fmu.c_str(), ZIP_RDONLY, &code));
  if (!archive) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    throw Misuse(fmt::format("{}: it is no zip archive, as an FMU is: {}", fmu.string(), reason));
  }
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    const auto number = static_cast<zip_uint64_t>(i);
    const char* const name = zip_get_name(archive.get(), number, 0);
    if (!name || !isWanted(name)) continue;
    requireInsideFolder(fmu, name);
    writeEntry(fmu, archive.get(), number, folder / name);
  }
}

}  // namespace

Unpacked unpack(const fs::path& fmu) {
  const std::string hash = hexText(fnv1a(readInputFile(fmu.string(), kMaxBytes)));
  const fs::path folder = cacheFolder("fmus") / fmt::format("{}_{}", fmu.stem().string(), hash);
  std::error_code none;
  if (fs::exists(folder, none)) return {folder, hash};
  const fs::path made = folder.string() + fmt::format(".{}", getpid());
  fs::remove_all(made, none);
  try {
    fs::create_directories(made);
    unpackTo(fmu, made);
  } catch (...) {
    fs::remove_all(made, none);
    throw;
  }
  fs::rename(made, folder, none);
  if (none) fs::remove_all(made);  // another process was faster
  return {folder, hash};
}

}  // namespace irk::own
