#include <fmt/format.h>
#include <fmt/ostream.h>

#include "core/base/constants.h"
#include "core/base/text.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/list_scenes.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/study/analysis.h"
#include "experiments/study/builtin_studies.h"
#include "experiments/study/study_reader.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

void listScenes(std::ostream& out) { printScenes({}, out); }

void listMethods(std::ostream& out) {
  for (const auto& family : familyCatalogue()) {
    fmt::print(out, "{}_S  {}, order {}, S = {} .. {}\n", family.id, family.title, family.order, family.min_stages,
               kMaxStages);
  }
  out << "or the path of a tableau file\nintegrators of other libraries, with their own step control:\n";
  for (const auto& peer : peerCatalogue()) fmt::print(out, "{:<12} {}\n", peer.id, peer.title);
}

void listStudies(std::ostream& out) {
  for (const auto& study : builtinStudies()) {
    const Study full = loadStudy(study.id, StudyVariant::kFull);
    std::size_t runs = 0;
    for (const auto& series : full.series) runs += series.runs.size();
    fmt::print(out, "{:<12} {} (at most {} runs)\n", study.id, full.title, runs);
  }
}

void listAnalyses(std::ostream& out) {
  for (const auto& analysis : analyses()) {
    fmt::print(out, "{:<12} {}: {} from {}; a study asks by its key '{}'\n", analysis.id, analysis.meaning,
               analysis.writes, analysis.reads, analysis.key);
  }
}

void listStrategies(std::ostream& out) {
  for (const auto& field : specFields()) {
    if (field.kind != FieldKind::kAxis) continue;
    fmt::print(out, "{}  {}\n", field.name, field.meaning);
    for (const auto& choice : field.choices()) fmt::print(out, "    {:<20} {}\n", choice.id, choice.meaning);
  }
}

void listNumbers(std::ostream& out) {
  for (const auto& field : specFields()) {
    if (field.isNumeric()) fmt::print(out, "{:<20} {}\n", field.name, helpText(field));
  }
}

void listConstants(std::ostream& out) {
  for (const Constant* one : kConstants) {
    fmt::print(out, "{:<26} {:<8g} {}\n{:<35} {}\n", one->name, one->value, one->decides, "", one->source);
  }
}

void listColumns(std::ostream& out) { out << kColumnsPage; }

struct List {
  const char* id;
  void (*print)(std::ostream&);
};
constexpr List kLists[] = {{"scenes", listScenes},       {"methods", listMethods},       {"studies", listStudies},
                           {"analyses", listAnalyses},   {"strategies", listStrategies}, {"numbers", listNumbers},
                           {"constants", listConstants}, {"columns", listColumns}};

}  // namespace

int listCommand(const std::string& what, const SceneList& scenes, Streams streams) {
  if (what == "scenes") return printScenes(scenes, streams.out), 0;
  if (!scenes.scene.empty()) throw Misuse("irk list " + what + " takes no name: '" + scenes.scene + "'");
  if (!scenes.collection.empty() || scenes.long_form || scenes.json) {
    throw Misuse("--collection, --long and --json belong to: irk list scenes");
  }
  std::vector<std::string> known;
  bool printed = false;
  for (const auto& list : kLists) {
    known.emplace_back(list.id);
    if (!what.empty() && what != list.id) continue;
    if (what.empty()) fmt::print(streams.out, "{}== {}\n", printed ? "\n" : "", list.id);
    list.print(streams.out);
    printed = true;
  }
  if (!printed) throw Misuse(unknownName("list", what, known));
  return 0;
}

}  // namespace irk
