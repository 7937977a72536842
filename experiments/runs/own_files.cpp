#include "experiments/runs/own_files.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "experiments/base/child_process.h"
#include "experiments/own/files.h"
#include "experiments/own/foreign/scene_library.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/loaded/load_method.h"
#include "irk/misuse.h"

namespace irk {
namespace {

std::vector<std::string> items(std::string_view files) {
  std::vector<std::string> all;
  while (!files.empty()) {
    const auto end = std::min(files.find(':'), files.size());
    if (end > 0) all.emplace_back(files.substr(0, end));
    files.remove_prefix(std::min(end + 1, files.size()));
  }
  return all;
}

bool isLoaded(std::string_view file) { return own::isFile(file) || isLibrary(file); }

// The file of a loaded solver, or of a tableau.
std::string fileOfMethod(const std::string& method) {
  if (const PeerEntry* peer = findPeer(method)) {
    const std::string library = libraryOf(method);
    return library.empty() ? own::fileWithHash(peer->source) : library;
  }
  std::error_code error;
  const bool is_file = method.find_first_of("./") != method.npos && std::filesystem::is_regular_file(method, error);
  return is_file ? std::filesystem::absolute(method).lexically_normal().string() : "";
}

}  // namespace

void loadOwn(const std::string& file) {
  if (!isLoaded(file)) throw Misuse("'" + file + "' cannot be loaded: FILE.cpp, MODEL.fmu or LIBRARY.so is expected");
  const bool is_code = file.find('@') != file.npos;  // of a library with Fortran codes
  if (own::isFile(file) || (!is_code && own::holdsScene(file))) {
    own::loadFile(file);
  } else {
    static_cast<void>(loadMethod(file));
  }
}

std::string filesOf(const RunSpec& spec) {
  std::vector<std::string> files;
  const auto add = [&files](std::string file) {
    const bool known = std::find(files.begin(), files.end(), file) != files.end();
    if (!file.empty() && !known) files.push_back(std::move(file));
  };
  add(own::fileWithHash(own::hashOf("scene", spec.scene)));
  for (const auto& field : specFields()) {
    if (field.kind == FieldKind::kAxis) add(own::fileWithHash(own::hashOf(field.name, field.get(spec))));
  }
  add(fileOfMethod(spec.method));
  std::string text;
  for (const auto& file : files) text += (text.empty() ? "" : ":") + file;
  return text;
}

std::string codeOf(const RunSpec& spec) {
  std::string code;
  for (const auto& file : items(filesOf(spec))) {
    if (isLoaded(file)) code += (code.empty() ? "code of " : " or ") + own::givenName(file);
  }
  return code;
}

std::string loadOptions(std::string_view files) {
  std::string options;
  for (const auto& file : items(files)) {
    if (isLoaded(file)) options += " --load " + shellWord(file);
  }
  return options;
}

std::string methodIn(std::string_view files, const std::string& method) {
  const auto all = items(files);
  const auto tableau = std::find_if(all.begin(), all.end(), [](const auto& file) { return !isLoaded(file); });
  return tableau == all.end() ? method : *tableau;
}

}  // namespace irk
