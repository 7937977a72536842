#include "experiments/environment.h"

#include <cstdlib>
#include <ctime>
#include <fstream>

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
  if (const char* home = std::getenv("IRK_HOME")) return home;
  if (std::filesystem::is_directory("plots")) return ".";
  return buildInfo().source_dir;
}

}  // namespace irk
