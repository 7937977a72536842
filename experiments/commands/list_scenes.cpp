#include "experiments/commands/list_scenes.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <nlohmann/json.hpp>

#include "irk/collections.h"
#include "irk/scene.h"

namespace irk {
namespace {

using Json = nlohmann::ordered_json;

std::vector<const SceneEntry*> scenesWanted(const SceneList& wanted) {
  std::vector<const SceneEntry*> scenes;
  if (!wanted.scene.empty()) {
    scenes.push_back(&findScene(wanted.scene));
  } else if (!wanted.collection.empty()) {
    for (const auto& id : scenesOf(wanted.collection)) scenes.push_back(&findScene(id));
  } else {
    for (const auto& scene : sceneCatalogue()) scenes.push_back(&scene);
  }
  return scenes;
}

std::string rangeText(const Parameter& p) {
  if (p.text) return "text";
  std::string text;
  for (const auto& choice : p.choices) text += (text.empty() ? "" : " | ") + choice;
  return p.choices.empty() ? fmt::format("{:g} .. {:g}", p.min, p.max) : text;
}

// Numbers of unknowns with the default parameters; a scene outside the tree may offer only 50 digits, or lack a file.
std::string sizesText(const SceneEntry& scene) {
  if (!scene.make || scene.registered) return "";
  const Sizes n = makeScene<double>(scene, {}).sizes();
  std::string text = fmt::format("    unknowns: {} second-order, {} first-order, {} algebraic", n.nu, n.nx, n.nz);
  if (n.switches > 0) text += fmt::format("; {} switches", n.switches);
  return text + "\n";
}

std::string originOf(const SceneEntry& scene) {
  if (!scene.literature.empty()) return scene.literature;
  return scene.source.empty() ? "this suite" : scene.source;
}

void printScene(const SceneEntry& scene, std::ostream& out) {
  fmt::print(out, "{}\n    {}\n    kind: {}\n    index: {}\n{}    shows: {}\n", scene.id, scene.title,
             meaningOf(scene.kind), indexOf(scene.kind), sizesText(scene), scene.shows);
  if (!scene.collections.empty()) fmt::print(out, "    in: {}\n", fmt::join(scene.collections, ", "));
  fmt::print(out, "    from: {}\n", originOf(scene));
  for (const auto& p : scene.parameters) {
    fmt::print(out, "    --set {}={}  {} [{}]  {}\n", p.name, p.default_value, p.meaning, p.unit, rangeText(p));
  }
}

Json parameterObject(const Parameter& p) {
  Json object = {{"name", p.name}, {"default", p.default_value}, {"unit", p.unit}, {"meaning", p.meaning}};
  if (!p.choices.empty()) {
    object["choices"] = p.choices;
  } else if (!p.text) {
    object["min"] = p.min;
    object["max"] = p.max;
  }
  return object;
}

Json sceneObject(const SceneEntry& scene) {
  Json object = {{"id", scene.id},
                 {"title", scene.title},
                 {"kind", meaningOf(scene.kind)},
                 {"index", indexOf(scene.kind)},
                 {"shows", scene.shows},
                 {"collections", scene.collections},
                 {"literature", scene.literature}};
  if (scene.make && !scene.registered) {
    const Sizes n = makeScene<double>(scene, {}).sizes();
    object["sizes"] = {{"nu", n.nu}, {"nx", n.nx}, {"nz", n.nz}, {"switches", n.switches}};
  }
  object["parameters"] = Json::array();
  for (const auto& p : scene.parameters) object["parameters"].push_back(parameterObject(p));
  return object;
}

}  // namespace

void printScenes(const SceneList& wanted, std::ostream& out) {
  const auto scenes = scenesWanted(wanted);
  if (wanted.json) {
    Json all = Json::array();
    for (const auto* scene : scenes) all.push_back(sceneObject(*scene));
    out << all.dump(2) << '\n';
    return;
  }
  const bool long_form = wanted.long_form || !wanted.scene.empty();
  for (const auto* scene : scenes) {
    if (long_form) {
      printScene(*scene, out);
    } else {
      fmt::print(out, "{:<22} {}\n", scene->id, scene->title);
    }
  }
}

}  // namespace irk
