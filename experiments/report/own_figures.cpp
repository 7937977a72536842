#include "experiments/report/own_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/base/input_file.h"
#include "experiments/report/default_figures.h"
#include "experiments/report/scripts.h"
#include "experiments/study/analysis.h"
#include "experiments/study/builtin_studies.h"
#include "experiments/tables/environment.h"
#include "experiments/tables/new_file.h"
#include "irk/misuse.h"

namespace irk {
namespace {

bool isBuiltIn(std::string_view id) {
  const auto studies = builtinStudies();
  return std::any_of(studies.begin(), studies.end(), [id](const BuiltinStudy& study) { return study.id == id; });
}

std::optional<std::filesystem::path> homeIfAny() {
  try {
    return homeFolder();
  } catch (const Misuse&) {
    return std::nullopt;
  }
}

std::vector<std::string> blockNames(const Study& study) {
  std::vector<std::string> names;
  for (const auto& series : study.series) {
    if (std::find(names.begin(), names.end(), series.block) == names.end()) names.push_back(series.block);
  }
  return names;
}

bool writes(const Analysis& analysis, std::string_view table) {
  return (" " + std::string(analysis.writes) + " ").find(" " + std::string(table) + " ") != std::string::npos;
}

// error_vs_step.gp can draw without orders.csv.
bool isOptional(const FigureTable& figure, std::string_view table) {
  return figure.script == "error_vs_step" && table == "orders.csv";
}

void requireTables(const Study& study, const FigureTable& figure, const Script& script) {
  for (const auto& table : script.tables) {
    for (const Analysis& analysis : analyses()) {
      const bool made = std::find(study.analyses.begin(), study.analyses.end(), &analysis) != study.analyses.end();
      if (made || !writes(analysis, table) || isOptional(figure, table)) continue;
      throw Misuse(fmt::format("{}: the script {} reads {}, which this study does not make: its key is '{}'",
                               figure.place, figure.script, table, analysis.key));
    }
    if (table.starts_with("audit") && !study.audit) {
      throw Misuse(
          fmt::format("{}: the script {} reads {}, which only an [audit] makes", figure.place, figure.script, table));
    }
    if (table == "tableaus.csv" || table == "stability.csv") {
      throw Misuse(fmt::format("{}: the script {} reads {}, which no study makes: see irk tableau", figure.place,
                               figure.script, table));
    }
  }
}

}  // namespace

FigureTables figuresOfStudy(const Study& study, const std::string& id_or_file) {
  if (isBuiltIn(study.id)) return {};
  FigureTables tables = parseFigureTables(readInputFile(id_or_file), id_or_file);
  if (tables.title.empty()) tables.title = study.id;
  if (tables.figures.empty()) {
    tables.figures = defaultFigures(study);
    return tables;
  }
  const auto home = homeIfAny();
  if (!home) return tables;
  const auto blocks = blockNames(study);
  for (const auto& figure : tables.figures) {
    checkFigure(figure, *home, blocks);
    requireTables(study, figure, readScript(*home, figure.script));
  }
  return tables;
}

void keepFigures(const FigureTables& figures, const std::filesystem::path& folder) {
  if (figures.figures.empty()) return;
  NewFile file(folder / kFiguresFile);
  file.out() << figureTablesText(figures);
  file.close();
}

std::vector<std::string> ownStudies(const std::filesystem::path& results) {
  std::vector<std::string> studies;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(results, none)) {
    const std::string id = entry.path().filename();
    if (!isBuiltIn(id) && std::filesystem::is_regular_file(entry.path() / kFiguresFile, none)) studies.push_back(id);
  }
  std::sort(studies.begin(), studies.end());
  return studies;
}

FigureTables keptFigures(const std::filesystem::path& results, const std::string& study) {
  const auto path = results / study / kFiguresFile;
  return parseFigureTables(readInputFile(path), path.string());
}

std::string ownTitle(const std::filesystem::path& results, const std::string& study) {
  try {
    return keptFigures(results, study).title;
  } catch (const Misuse&) {
    return study;
  }
}

}  // namespace irk
