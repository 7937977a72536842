#include "experiments/report/default_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "experiments/report/block_figures.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/solution/trajectory.h"
#include "experiments/study/analysis.h"

namespace irk {
namespace {

using Cells = std::vector<std::string>;

// The figures of analyses, which need no choice of a block.
void appendAnalyses(const Study& study, std::vector<FigureTable>& figures) {
  const auto add = [&](const std::string& script, const std::string& title, std::vector<FigureOption> options = {}) {
    figures.push_back({script, {}, title, {}, std::move(options), {}});
  };
  Cells scenes, methods;
  for (const auto& series : study.series) {
    const RunSpec spec = series.runs.front();
    addNew(scenes, spec.scene);
    if (!findPeer(spec.method)) addNew(methods, spec.method);
  }
  for (const auto& scene : study.trajectories ? scenes : Cells()) {
    const auto of = [&](const Series& series) { return series.runs.front().scene == scene; };
    const RunSpec spec = (*std::find_if(study.series.begin(), study.series.end(), of)).runs.front();
    add("scene_solution", "Solution over time: " + scene,
        {{"scene", {scene}}, {"file_name", {trajectoryPath({}, spec).stem().string()}}});
    figures.back().caption = spec.method;
  }
  for (const Analysis* analysis : study.analyses) {
    if (analysis->id == "profile") add("profile", "Performance profiles over all scenes", {{"targets", {"all"}}});
    if (analysis->id == "robustness") {
      add("robustness", "Right, failed or wrong, by solver and tolerance", {{"collections", {"all"}}});
    }
    if (analysis->id == "estimates") add("estimate_ratio", "True error of a step over its estimate");
    if (analysis->id != "phases" && analysis->id != "scaling") continue;
    const bool phases = analysis->id == "phases";
    for (const auto& scene : scenes) {
      add(phases ? "shares" : "scaling",
          fmt::format("{}: {}", phases ? "Where the time goes" : "Time of a step over the number of unknowns", scene),
          {{"scene", {scene}}, {"methods", methods, FigureOption::Kind::kList}});
    }
  }
}

// Whether gnuplot would interpret a character, as in the path of a tableau.
bool isPlainText(const FigureTable& figure) {
  return std::all_of(figure.options.begin(), figure.options.end(), [](const FigureOption& option) {
    return std::all_of(option.items.begin(), option.items.end(),
                       [](const std::string& item) { return item.find_first_of("'\"`\\") == item.npos; });
  });
}

// Names of one script are numbered from the second on.
void nameFigures(std::vector<FigureTable>& figures) {
  std::map<std::string, int> count;
  for (auto& figure : figures) {
    const int number = ++count[figure.script];
    figure.name = number == 1 ? figure.script : fmt::format("{}_{}", figure.script, number);
  }
}

}  // namespace

std::vector<FigureTable> defaultFigures(const Study& study) {
  std::vector<FigureTable> figures;
  if (study.audit) {
    for (const std::string script : {"audit", "audit_errors"}) {
      figures.push_back({script, script, "Can success be believed?", {}, {}, {}});
    }
    return figures;
  }
  Cells blocks;
  for (const auto& series : study.series) addNew(blocks, series.block);
  for (const auto& block : blocks) appendBlockFigures(study, block, figures);
  appendAnalyses(study, figures);
  std::erase_if(figures, [](const FigureTable& figure) { return !isPlainText(figure); });
  nameFigures(figures);
  return figures;
}

}  // namespace irk
