#include "experiments/environment.h"

#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <fstream>

#include "core/misuse.h"
#include "experiments/build_info.h"

namespace irk {
namespace {

std::string cpuName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

}  // namespace

TableHead environmentHead(const std::string& study, int threads) {
  const BuildInfo& build = buildInfo();
  return {{"study", study},
          {"version", std::string(build.version)},
          {"commit", std::string(build.commit)},
          {"compiler", std::string(build.compiler)},
          {"flags", std::string(build.flags)},
          {"cpu", cpuName()},
          {"threads", std::to_string(threads)},
          {"date", dateText()}};
}

std::string dateText() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

std::filesystem::path homeFolder() {
  namespace fs = std::filesystem;
  const auto isHome = [](const fs::path& folder) {
    std::error_code none;
    return fs::is_regular_file(folder / "plots" / "figures.txt", none);
  };
  if (const char* home = std::getenv("IRK_HOME")) {
    if (isHome(home)) return home;
    throw Misuse(fmt::format("IRK_HOME = '{}': a folder with plots/figures.txt is expected", home));
  }
  const fs::path sources = buildInfo().source_dir;
  if (isHome(sources)) return sources;
  // The tree was moved: the program lies below it, in build/release.
  std::error_code error;
  fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (int up = 0; up < 3 && !error; ++up, folder = folder.parent_path()) {
    if (isHome(folder)) return folder;
  }
  throw Misuse(fmt::format("no plots/figures.txt in {} or above the program: set IRK_HOME to the folder of the sources",
                           sources.string()));
}

}  // namespace irk
