#include "experiments/runner/study_file.h"

#include <fmt/format.h>

#include <fstream>
#include <string>

#include "core/base/input_file.h"
#include "experiments/tables/new_file.h"
#include "irk/misuse.h"

namespace irk {

void keepStudyFile(const std::filesystem::path& study, const std::filesystem::path& folder) {
  const auto kept = folder / "study_file";
  const std::string path = std::filesystem::canonical(study).string();
  std::string other;
  std::ifstream in(kept);
  if (std::getline(in, other) && other == path) return;
  if (std::filesystem::is_regular_file(other) && readInputFile(other) != readInputFile(study)) {
    throw Misuse(
        fmt::format("{} holds the results of {}, another study of the same name: rename {}, or keep its results "
                    "elsewhere with --results",
                    folder.string(), other, path));
  }
  std::filesystem::create_directories(folder);
  NewFile file(kept);
  file.out() << path << '\n';
  file.close();
}

}  // namespace irk
