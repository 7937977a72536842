#include "experiments/tables/environment.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <gnu/libc-version.h>
#ifdef IRK_HAS_GSL
#include <gsl/gsl_version.h>
#endif
#include <omp.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_version.h>
#if __has_include(<suitesparse/klu.h>)
#include <suitesparse/klu.h>
#endif
#include <sys/utsname.h>
#include <unistd.h>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "experiments/base/numbers.h"
#include "experiments/tables/build_info.h"
#include "irk/misuse.h"

namespace irk {
namespace {

std::string readProcessorName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

double memoryInGb() {
  const double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  return bytes / (1 << 30);
}

// `Debian GNU/Linux 12 (bookworm), Linux 6.1.0-18-amd64`
std::string operatingSystem() {
  constexpr std::string_view kKey = "PRETTY_NAME=";
  std::string distribution = "unknown";
  std::ifstream in("/etc/os-release");
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(kKey)) continue;
    distribution = line.substr(kKey.size());
    std::erase(distribution, '"');
  }
  utsname kernel{};
  if (uname(&kernel) != 0) return distribution;
  return fmt::format("{}, {} {}", distribution, kernel.sysname, kernel.release);
}

std::string kluVersion() {
#ifdef KLU_MAIN_VERSION
  return fmt::format("{}.{}.{}", KLU_MAIN_VERSION, KLU_SUB_VERSION, KLU_SUBSUB_VERSION);
#else
  return "unknown";
#endif
}

// `6.4.1, /usr/lib/x86_64-linux-gnu/libsundials_cvode.so.6.4.1`: the library that is in use, which need not be that of
// the headers; since version 7 also what it was compiled with. A library from Debian and one of the user's own can
// differ by a factor of three in time.
std::string sundialsVersion() {
  char version[64] = "unknown";
  SUNDIALSGetVersion(version, sizeof version);
  std::string text = version;
#if defined(SUN_C_COMPILER) && defined(SUN_BUILD_TYPE)
  text += fmt::format(", {} {} {}", SUN_C_COMPILER, SUN_C_COMPILER_VERSION, SUN_BUILD_TYPE);
  if (*SUN_C_COMPILER_FLAGS) text += fmt::format(" {}", SUN_C_COMPILER_FLAGS);
#endif
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&SUNDIALSGetVersion), &info) == 0 || !info.dli_fname) return text;
  std::error_code none;
  const auto file = std::filesystem::canonical(info.dli_fname, none);
  return none ? text : fmt::format("{}, {}", text, file.string());
}

std::string gslVersion() {
#ifdef IRK_HAS_GSL
  return gsl_version;
#else
  return "none";
#endif
}

std::string libraryVersions() {
  return fmt::format("{}; glibc {}; Eigen {}.{}.{}; Boost {}; GSL {}; SUNDIALS {}; KLU {}; fmt {}.{}.{}",
                     operatingSystem(), gnu_get_libc_version(), EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION,
                     EIGEN_MINOR_VERSION, BOOST_LIB_VERSION, gslVersion(), sundialsVersion(), kluVersion(),
                     FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100);
}

TableRow makeEnvironment() {
  const BuildInfo& build = buildInfo();
  TableRow row{"",
               std::string(build.commit),
               std::string(build.version),
               hostName(),
               processorName(),
               std::to_string(omp_get_num_procs()),
               fmt::format("{:.1f}", memoryInGb()),
               std::string(build.compiler),
               std::string(build.flags),
               libraryVersions()};
  row.front() = hexText(fnv1a(csvLine(row)));
  row.push_back(dateText());
  return row;
}

}  // namespace

std::vector<std::string> environmentColumns() {
  return {"environment", "commit",   "version", "host",      "cpu",       "cores",
          "memory_gb",   "compiler", "flags",   "libraries", "first_date"};
}

const TableRow& thisEnvironment() {
  static const TableRow row = makeEnvironment();
  return row;
}

const std::string& processorName() {
  static const std::string name = readProcessorName();
  return name;
}

std::string hostName() {
  char name[256] = "";
  if (gethostname(name, sizeof name - 1) != 0 || name[0] == '\0') return "unknown";
  return name;
}

TableHead environmentHead(const std::string& study, int threads) {
  const BuildInfo& build = buildInfo();
  return {{"study", study},
          {"version", std::string(build.version)},
          {"commit", std::string(build.commit)},
          {"compiler", std::string(build.compiler)},
          {"flags", std::string(build.flags)},
          {"cpu", processorName()},
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
  std::error_code error;
  fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path installed = (folder / buildInfo().data_dir).lexically_normal();
  if (!error && isHome(installed)) return installed;
  const fs::path sources = buildInfo().source_dir;
  if (isHome(sources)) return sources;
  // The source tree was moved: search upwards from the program, which lies in build/release.
  for (int up = 0; up < 3 && !error; ++up, folder = folder.parent_path()) {
    if (isHome(folder)) return folder;
  }
  throw Misuse(
      fmt::format("no plots/figures.txt in {}, in {} or above the program: set IRK_HOME to the folder that "
                  "contains plots/",
                  installed.string(), sources.string()));
}

}  // namespace irk
