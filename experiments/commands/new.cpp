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
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
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

void requireNew(const std::filesystem::path& path) {
  if (std::filesystem::exists(path)) throw Misuse(fmt::format("'{}' exists; it is left as it is", path.string()));
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
  requireNew(path);
}

void write(const std::filesystem::path& path, std::string_view text) {
  std::ofstream out(path);
  out << text;
  out.close();
  if (!out) throw Failure(fmt::format("'{}' cannot be written", path.string()));
}

void newScene(const std::string& file, std::ostream& out) {
  const std::filesystem::path path(file);
  requireSceneFile(path);
  const std::string id = path.stem().string();
  std::string text(own::kSceneTemplate);
  replacePlaceholder(text, kTemplateId, id);
  replacePlaceholder(text, kTemplateStruct, structName(id));
  write(path, text);
  fmt::print(out, "{0}: a scene that runs: irk solve {0} --method radau_iia_5 --tol 1e-8\n", file);
}

std::string methodBlock(std::string_view name, std::string_view methods, std::string_view more) {
  return fmt::format("\n[[block]]\nname = \"{}\"\nmethods = [{}]\n{}", name, methods, more);
}

// The blocks of a study of costs. Constraints are of index 2, which not every code can solve; in index 1 they are
// differentiated twice.
std::string costBlocks(bool constrained) {
  std::string text =
      methodBlock("fixed_order", R"("radau_iia_3", "radau_iia_5", "radau_iia_9")", "configuration = \"embedded\"\n");
  text += methodBlock("variable_order", "\"radau_iia\"", "configuration = \"variable\"\n");
  if (!findPeer("ida_bdf") || !findPeer("cvode_bdf")) return text;
  if (!constrained) return text + methodBlock("sundials", R"("cvode_bdf", "ida_bdf")", "");
  text += methodBlock("sundials", "\"ida_bdf\"", "");
  text += methodBlock("sundials_index1", "\"cvode_bdf\"",
                      "formulation = \"index1\"              # constraints differentiated twice, for y' = f(t, y)\n");
  return text;
}

void newStudy(const std::string& scene, std::ostream& out) {
  const std::string id = sceneNamed(scene);
  const bool constrained = makeScene<double>(id).sizes().constraints > 0;
  const std::filesystem::path path = std::filesystem::path(scene).replace_filename(id + "_costs.toml");
  requireNew(path);
  const std::string named = std::filesystem::path(scene).filename().string();
  std::string text = fmt::format(R"(# irk run {1}, then irk plot {1}: a figure of the CPU time over the error.
title = "{0}: costs"
targets = [1e-4, 1e-6, 1e-8]          # compare the cost of these errors: cpu_at_error.csv

[defaults]                            # for all blocks
scene = "{2}"
reference = "auto"                    # errors need a reference: if none is stored, it is computed once, and kept
tolerances = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10]
time_limit = 10                       # seconds of one run

[timing]                              # measure CPU times in a second pass

# Each block is one sweep: all combinations of its lists.
)",
                                 id, path.string(), named);
  text += costBlocks(constrained);
  text += fmt::format(R"(
[[figure]]                            # all blocks in one panel, a curve for each method
script = "work_by"
variant = "method"
cases = "{0}"
title = "{0}: CPU time over the error"
caption = "radau_iia chooses its order; the others have a fixed method.{1}"
)",
                      id, constrained ? " cvode_bdf solves the equations in index 1, the others in index 2." : "");
  write(path, text);
  fmt::print(out, "{0}: a study of costs: irk run {0}, then irk plot {0}\n", path.string());
}

}  // namespace

int newCommand(const std::string& kind, const std::string& file, Streams streams) {
  if (kind == "scene") {
    newScene(file, streams.out);
  } else if (kind == "study") {
    newStudy(file, streams.out);
  } else {
    throw Misuse(unknownName("thing to write", kind, {"scene", "study"}));
  }
  return 0;
}

}  // namespace irk
