#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "core/base/text.h"
#include "experiments/base/failure.h"
#include "experiments/base/html.h"
#include "experiments/commands/commands.h"
#include "experiments/own/scene_template.h"
#include "irk/misuse.h"
#include "irk/scene.h"

namespace irk {
namespace {

constexpr std::string_view kTemplateId = "my_mechanism", kTemplateStruct = "MyMechanism";

// four_bar gives FourBar.
std::string structName(const std::string& id) {
  std::string name;
  bool starts = true;
  for (const char c : id) {
    if (c != '_') name += starts ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    starts = c == '_';
  }
  return name;
}

void requireSceneFile(const std::filesystem::path& path) {
  const std::string id = path.stem().string();
  const auto isPlain = [](char c) { return std::islower(c) || std::isdigit(c) || c == '_'; };
  if (path.extension() != ".cpp" || id.empty() || !std::islower(id.front()) ||
      !std::all_of(id.begin(), id.end(), isPlain)) {
    throw Misuse(fmt::format("'{}': a file such as four_bar.cpp is expected: small letters, digits and '_', then .cpp",
                             path.string()));
  }
  for (const auto& scene : sceneCatalogue()) {
    if (scene.id == id) throw Misuse(fmt::format("'{}': the program has a scene '{}'", path.string(), id));
  }
  if (std::filesystem::exists(path)) throw Misuse(fmt::format("'{}' exists; it is left as it is", path.string()));
}

}  // namespace

int newCommand(const std::string& kind, const std::string& file, Streams streams) {
  if (kind != "scene") throw Misuse(unknownName("thing to write", kind, {"scene"}));
  const std::filesystem::path path(file);
  requireSceneFile(path);
  const std::string id = path.stem().string();
  std::string text(own::kSceneTemplate);
  replacePlaceholder(text, kTemplateId, id);
  replacePlaceholder(text, kTemplateStruct, structName(id));
  std::ofstream out(path);
  out << text;
  out.close();
  if (!out) throw Failure(fmt::format("'{}' cannot be written", file));
  fmt::print(streams.out, "{0}: a scene that runs: irk solve {0} --method radau_iia_5 --tol 1e-8\n", file);
  return 0;
}

}  // namespace irk
