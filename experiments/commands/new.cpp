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
#include "experiments/runs/peers/peer_integrator.h"
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

// Whether an integrator of another library can run the scene in this formulation.
bool canRun(const PeerEntry& peer, const Scene<double>& scene, Formulation formulation) {
  RunSpec spec;
  spec.scene = scene.id;
  spec.method = peer.id;
  spec.formulation = formulation;
  try {
    PeerIntegrator(peer, scene, spec);
    return true;
  } catch (const Misuse&) {
    return false;
  }
}

// The blocks of a study of costs: SUNDIALS in the default formulation, or in index 1 where it can run that only.
std::string costBlocks(const Scene<double>& scene) {
  std::string text =
      methodBlock("fixed_order", R"("radau_iia_3", "radau_iia_5", "radau_iia_9")", "configuration = \"embedded\"\n");
  text += methodBlock("variable_order", "\"radau_iia\"", "configuration = \"variable\"\n");
  for (const char* id : {"cvode_bdf", "ida_bdf"}) {
    const PeerEntry* const peer = findPeer(id);
    const auto runs = [&](Formulation formulation) { return peer && canRun(*peer, scene, formulation); };
    const std::string quoted = fmt::format("\"{}\"", id);
    if (runs(RunSpec{}.formulation)) {
      text += methodBlock(id, quoted, "");
    } else if (runs(Formulation::kIndex1)) {
      text += methodBlock(id, quoted, "formulation = \"index1\"              # constraints differentiated twice\n");
    }
  }
  return text;
}

void newStudy(const std::string& scene, std::ostream& out) {
  const std::string id = sceneNamed(scene);
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
  const std::string blocks = costBlocks(makeScene<double>(id));
  const bool index1 = blocks.find("index1") != blocks.npos;
  text += blocks;
  text += fmt::format(R"(
[[figure]]                            # all blocks in one panel, a curve for each method
script = "work_by"
variant = "method"
cases = "{0}"
title = "{0}: CPU time over the error"
caption = "radau_iia chooses its order; the others have a fixed method.{1}"
)",
                      id, index1 ? " cvode_bdf solves the equations in index 1, the others in index 2." : "");
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
