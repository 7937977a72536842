#include "experiments/study/toml/own_files.h"

#include <fmt/format.h>

#include <filesystem>

#include "experiments/own/files.h"
#include "experiments/runs/own_files.h"
#include "experiments/runs/peers/loaded/load_method.h"
#include "irk/misuse.h"

namespace irk {
namespace {

void findFiles(StudyValue& value, const std::string& study_file) {
  const auto folder = std::filesystem::path(study_file).parent_path();
  for (auto& item : value.items) {
    const auto at = item.find('@') + 1;  // of a code in a library: radau5@libradau5.so; else 0
    const std::filesystem::path path = item.substr(at);
    const bool is_file = own::isFile(item) || isLibrary(item) || std::filesystem::is_regular_file(folder / path);
    if (is_file && path.is_relative()) item = item.substr(0, at) + (folder / path).string();
  }
}

void load(const StudyValue& files) {
  try {
    for (const auto& file : files.items) loadOwn(file);
  } catch (const Misuse& misuse) {
    throw Misuse(fmt::format("{}: load: {}", files.place, misuse.what()));
  }
}

}  // namespace

void loadOwnFiles(StudyFile& study, const std::string& study_file) {
  const auto files = study.study.find("load");
  if (files != study.study.end()) {
    findFiles(files->second, study_file);
    load(files->second);
  }
  const auto drawn = study.study.find("audit.scene");
  if (drawn != study.study.end()) findFiles(drawn->second, study_file);
  for (auto& block : study.blocks) {
    for (const auto* key : {"scene", "methods"}) {
      const auto at = block.find(key);
      if (at != block.end()) findFiles(at->second, study_file);
    }
  }
}

}  // namespace irk
