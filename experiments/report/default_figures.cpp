#include "experiments/report/default_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <set>

#include "core/options/fixed_steps.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/solution/trajectory.h"
#include "experiments/study/analysis.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

constexpr std::size_t kMostFigures = 6;  // of one kind for one block
constexpr std::size_t kMostPanels = 6;

using Cells = std::vector<std::string>;

void addNew(auto& list, const auto& item) {
  if (std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
}

// A column of runs.csv, and its value in the row of a run.
struct Axis {
  std::string column;
  std::function<std::string(const RunSpec&)> value;
};

// The first run of each series of a block, or of 2000 series, spread over the block's lists.
std::vector<RunSpec> sampleOf(const Study& study, const std::vector<std::size_t>& series) {
  constexpr std::size_t kMost = 2000, kStride = 1'000'003;  // a prime
  const std::size_t count = series.size();
  std::vector<RunSpec> specs;
  for (std::size_t k = 0; k < std::min(count, kMost); ++k) {
    specs.push_back(study.series[series[count <= kMost ? k : k * kStride % count]].runs.front());
  }
  return specs;
}

// The columns in which the runs of a scene differ; the first one, which tells curves apart, is the method or the
// integrator unless that is the same in all runs. A column that follows from those before it is left out, as a strategy
// that a configuration sets.
std::vector<Axis> axesOf(const std::vector<RunSpec>& specs, bool fixed) {
  const auto field = [](const std::string& name) { return Axis{name, findField(name).get}; };
  const auto& first = specs.front();
  const bool one = std::all_of(specs.begin(), specs.end(),
                               [&](const RunSpec& spec) { return spec.configuration == first.configuration; });
  const Axis method = one || fixed ? field("method") : Axis{"integrator", integratorName};
  std::vector<Axis> axes{field("scene"), method, field("configuration")};
  for (const auto& other : specFields()) {
    if (!other.swept) axes.push_back({other.name, other.get});
  }
  std::vector<Cells> cells(specs.size());
  std::size_t kinds = 1;
  std::erase_if(axes, [&](const Axis& axis) {
    auto finer = cells;
    for (std::size_t i = 0; i < specs.size(); ++i) finer[i].push_back(axis.value(specs[i]));
    const std::size_t number = std::set(finer.begin(), finer.end()).size();
    if (number == kinds) return true;
    kinds = number;
    cells = std::move(finer);
    return axis.column == "scene";
  });
  // Lines of error_vs_step.gp are methods.
  if (axes.empty() || (fixed && axes.front().column != "method")) axes.insert(axes.begin(), method);
  return axes;
}

// The groups of components of a run's scene: position and velocity, state, multiplier.
Cells componentsOf(const RunSpec& spec) {
  const Sizes n = makeScene<double>(spec.scene, settingsAtStep(spec)).sizes();
  Cells components;
  if (n.nu > 0) components = {"u", "v"};
  if (n.nx > 0) components.emplace_back("x");
  if (n.nz > 0) components.emplace_back("z");
  return components;
}

// The families of these methods that gnuplot can take as a word.
Cells familiesOf(const std::vector<RunSpec>& specs) {
  std::set<std::string> methods;
  for (const auto& spec : specs) methods.insert(spec.method);
  Cells families;
  for (const auto& method : methods) {
    if (findPeer(method) || isFamily(method)) continue;
    const std::string family = makeTableau<double>(method).family;
    const auto isPlain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
    if (std::all_of(family.begin(), family.end(), isPlain)) addNew(families, family);
  }
  return families;
}

/// The figures of one block.
class Block {
 public:
  Block(const Study& study, std::string name, const std::vector<std::size_t>& series)
      : study_(study), name_(std::move(name)), specs_(sampleOf(study, series)) {
    fixed_ = std::any_of(specs_.begin(), specs_.end(), [](auto& spec) { return hasFixedSteps(spec.options.step); });
    axes_ = axesOf(specs_, fixed_);
    for (const auto& spec : specs_) addNew(scenes_, spec.scene);
    for (const auto& spec : specs_) {
      Cells cells;
      for (std::size_t i = 1; i < axes_.size(); ++i) cells.push_back(axes_[i].value(spec));
      addNew(settings_, cells);
      if (settings_.size() == kMostFigures) break;
    }
  }

  std::vector<FigureTable> figures() const {
    std::vector<FigureTable> all;
    if (!fixed_) {
      for (const auto& values : settings_) all.push_back(work(values));
      return all;
    }
    const auto append = [&](auto figure) {
      for (const auto& scene : scenes_) {
        const auto spec = *std::find_if(specs_.begin(), specs_.end(), [&](auto& s) { return s.scene == scene; });
        for (const auto& values : settings_) all.push_back((this->*figure)(values, spec));
      }
    };
    const auto is_orders = [](const Analysis* analysis) { return analysis->id == "orders"; };
    if (!familiesOf(specs_).empty()) append(&Block::errors);
    if (std::any_of(study_.analyses.begin(), study_.analyses.end(), is_orders) && haveOrders()) append(&Block::orders);
    return all;
  }

 private:
  // orders.csv has no other columns that tell settings apart.
  bool haveOrders() const {
    return std::all_of(axes_.begin() + 1, axes_.end(),
                       [](const Axis& axis) { return axis.column == "formulation" || axis.column == "settings"; });
  }

  FigureTable start(const std::string& script, std::string title, const Cells& values) const {
    for (std::size_t i = 0; i < values.size(); ++i) title += fmt::format(", {}={}", axes_[i + 1].column, values[i]);
    return {.script = script, .name = {}, .title = std::move(title), .caption = {}};
  }

  void choose(FigureTable& figure, const Cells& values) const {
    Cells only;
    for (std::size_t i = 0; i < values.size(); ++i) only.push_back(axes_[i + 1].column + "=" + values[i]);
    if (!only.empty()) figure.options.push_back({"only", only, FigureOption::Kind::kList});
  }

  FigureTable work(const Cells& values) const {
    auto figure = start("work_by", "Work and accuracy: " + name_, values);
    Cells cases;
    for (const auto& scene : scenes_) {
      if (cases.size() < kMostPanels) cases.push_back(fmt::format("block={}:{}", name_, scene));
    }
    const bool timed = study_.timing.wanted;
    figure.options = {{"variant", {axes_.front().column}},
                      {"cases", cases, FigureOption::Kind::kList},
                      {"costs", {timed ? "cpu_s" : "residuals"}}};
    if (cases.size() > 2) figure.options.push_back({"columns", {"3"}, FigureOption::Kind::kNumber});
    choose(figure, values);
    figure.caption = fmt::format(
        "{} over the error reached; accuracy increases to the right, lower curves are {}. An error that is too small "
        "for "
        "its reference stands at ten times the reference's accuracy.",
        timed ? "CPU time" : "Residual evaluations", timed ? "faster" : "cheaper");
    return figure;
  }

  FigureTable errors(const Cells& values, const RunSpec& spec) const {
    auto figure = start("error_vs_step", fmt::format("Error over step: {}, {}", name_, spec.scene), values);
    const std::string component = componentsOf(spec).front();
    figure.options = {{"block", {name_}},
                      {"scene", {spec.scene}},
                      {"component", {component}},
                      {"families", familiesOf(specs_), FigureOption::Kind::kList}};
    choose(figure, values);
    figure.caption = fmt::format("Fixed steps; error of {}.", component == "u" ? "the positions" : "the states");
    return figure;
  }

  FigureTable orders(const Cells& values, const RunSpec& spec) const {
    auto figure = start("order_vs_stages", fmt::format("Observed order: {}, {}", name_, spec.scene), values);
    figure.options = {
        {"block", {name_}}, {"scene", {spec.scene}}, {"components", componentsOf(spec), FigureOption::Kind::kList}};
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!values[i].empty()) figure.options.push_back({axes_[i + 1].column, {values[i]}});
    }
    figure.caption =
        "Line: theory, or the order that a tableau declares. Mark: slope of the error over the step; a "
        "red cross: it differs.";
    return figure;
  }

  const Study& study_;
  std::string name_;
  std::vector<RunSpec> specs_;
  bool fixed_ = false;
  std::vector<Axis> axes_;       // curves first
  std::vector<Cells> settings_;  // the values of the other axes that occur together
  Cells scenes_;
};

// The figures of analyses and of solutions over time, which need no choice of a block.
std::vector<FigureTable> figuresOfAnalyses(const Study& study) {
  std::vector<FigureTable> figures;
  const auto add = [&](const std::string& script, const std::string& title, std::vector<FigureOption> options = {}) {
    figures.push_back({.script = script, .name = {}, .title = title, .caption = {}, .options = std::move(options)});
  };
  std::map<std::string, RunSpec> firsts;  // by scene
  Cells scenes, methods;
  for (const auto& series : study.series) {
    const RunSpec spec = series.runs.front();
    if (firsts.emplace(spec.scene, spec).second) scenes.push_back(spec.scene);
    if (!findPeer(spec.method)) addNew(methods, spec.method);
  }
  for (const auto& scene : study.trajectories ? scenes : Cells()) {
    const RunSpec& spec = firsts.at(scene);
    add("scene_solution", "Solution over time: " + scene,
        {{"scene", {scene}}, {"file_name", {trajectoryPath({}, spec).stem().string()}}});
    figures.back().caption = spec.method;
  }
  const auto addForScenes = [&](const std::string& script, const std::string& title) {
    for (const auto& scene : scenes) {
      add(script, title + ": " + scene, {{"scene", {scene}}, {"methods", methods, FigureOption::Kind::kList}});
    }
  };
  for (const Analysis* analysis : study.analyses) {
    if (analysis->id == "profile") add("profile", "Performance profiles over all scenes", {{"targets", {"all"}}});
    if (analysis->id == "robustness") {
      add("robustness", "Right, failed or wrong, by solver and tolerance", {{"collections", {"all"}}});
    }
    if (analysis->id == "estimates") add("estimate_ratio", "True error of a step over its estimate");
    if (analysis->id == "phases") addForScenes("shares", "Where the time goes");
    if (analysis->id == "scaling") addForScenes("scaling", "Time of a step over the number of unknowns");
  }
  return figures;
}

// Whether gnuplot would take all options as texts: a tableau's path may have quotes.
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
  std::vector<std::pair<std::string, std::vector<std::size_t>>> blocks;  // names, with the numbers of their series
  for (std::size_t i = 0; i < study.series.size(); ++i) {
    const std::string block = study.series[i].block;
    if (blocks.empty() || blocks.back().first != block) blocks.push_back({block, {}});
    blocks.back().second.push_back(i);
  }
  for (const auto& [name, series] : blocks) {
    for (auto& figure : Block(study, name, series).figures()) figures.push_back(std::move(figure));
  }
  for (auto& figure : figuresOfAnalyses(study)) figures.push_back(std::move(figure));
  std::erase_if(figures, [](const FigureTable& figure) { return !isPlainText(figure); });
  nameFigures(figures);
  return figures;
}

}  // namespace irk
