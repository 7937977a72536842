#include "experiments/report/block_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <iterator>
#include <map>
#include <set>

#include "core/options/fixed_steps.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/study/analysis.h"
#include "irk/misuse.h"
#include "irk/tableaus.h"

namespace irk {

void addNew(std::vector<std::string>& list, const std::string& item) {
  if (std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
}

namespace {

constexpr std::size_t kMostFigures = 6;  // of one kind for one block
constexpr std::size_t kMostPanels = 6;
constexpr std::size_t kFewStages = 3;  // fewer give no curve over the stages

using Cells = std::vector<std::string>;

// A column in which the runs of a block differ.
struct Axis {
  std::string column;
  std::function<std::string(const RunSpec&)> value;
};

Cells valuesOf(const Axis& axis, const std::vector<RunSpec>& specs) {
  Cells values;
  for (const auto& spec : specs) addNew(values, axis.value(spec));
  return values;
}

Cells cellsOf(const std::vector<Axis>& axes, const RunSpec& spec) {
  Cells cells;
  for (const auto& axis : axes) cells.push_back(axis.value(spec));
  return cells;
}

// Whether the values of `others` determine that of `axis`, as a configuration determines a strategy that it sets.
bool isDetermined(const Axis& axis, const std::vector<Axis>& others, const std::vector<RunSpec>& specs) {
  std::map<Cells, std::string> known;
  return std::all_of(specs.begin(), specs.end(), [&](const RunSpec& spec) {
    const auto value = axis.value(spec);
    return known.try_emplace(cellsOf(others, spec), value).first->second == value;
  });
}

// A family whose members occur in the block. The name is that of a tableau's header.
struct Family {
  std::string id;
  std::set<Index> stages;
};

// The numbers of the series of a block, or of 2000 of them, spread over its lists.
std::vector<std::size_t> sampleOf(const Study& study, const std::string& name) {
  constexpr std::size_t kMost = 2000, kStride = 1'000'003;  // a prime
  std::size_t first = study.series.size(), count = 0, number = 0;
  for (const auto& series : study.series) {
    if (series.block == name) {
      first = std::min(first, number);
      ++count;
    }
    ++number;
  }
  std::vector<std::size_t> sample;
  for (std::size_t k = 0; k < std::min(count, kMost); ++k)
    sample.push_back(first + (count <= kMost ? k : k * kStride % count));
  std::sort(sample.begin(), sample.end());
  return sample;
}

class Block {
 public:
  Block(const Study& study, const std::string& name) : study_(study), name_(name) {
    for (const std::size_t i : sampleOf(study, name)) {
      const Series series = study.series[i];
      specs_.push_back(series.runs.front());
      fixed_ = fixed_ || hasFixedSteps(specs_.back().options.step);
      orders_ = orders_ || series.end == SeriesEnd::kAsymptotic;
      levels_ = std::max(levels_, series.runs.size());
    }
    for (const auto& spec : specs_) addNew(scenes_, spec.scene);
    findAxes();
    findFamilies();
  }

  void append(std::vector<FigureTable>& figures) const;

 private:
  void findAxes();
  void findFamilies();
  bool has(std::string_view analysis) const {
    return std::any_of(study_.analyses.begin(), study_.analyses.end(),
                       [&](const Analysis* wanted) { return wanted->id == analysis; });
  }
  FigureTable start(const std::string& script, const std::string& title) const;
  FigureOption blockOption() const { return {"block", {name_}}; }
  std::vector<Cells> combinations(const std::vector<Axis>& axes) const;
  std::vector<Axis> besideMethods() const;
  std::string costColumn() const { return study_.timing.wanted ? "cpu_s" : "residuals"; }
  void work(std::vector<FigureTable>& figures) const;
  void errors(std::vector<FigureTable>& figures) const;
  void orders(std::vector<FigureTable>& figures) const;
  void costs(std::vector<FigureTable>& figures) const;
  void maps(std::vector<FigureTable>& figures) const;

  const Study& study_;
  std::string name_;
  std::vector<RunSpec> specs_;  // the first of each series
  Cells scenes_;
  std::vector<Axis> axes_;  // methods first
  std::vector<Family> families_;
  bool fixed_ = false, orders_ = false;
  std::size_t levels_ = 0;  // tolerances or steps
};

void Block::findAxes() {
  const auto varies = [&](const Axis& axis) {
    const std::string first = axis.value(specs_.front());
    return std::any_of(specs_.begin(), specs_.end(), [&](const RunSpec& spec) { return axis.value(spec) != first; });
  };
  const auto field = [](const std::string& name) { return Axis{name, findField(name).get}; };
  std::vector<Axis> known{field("scene")};
  // A configuration and its method together name the integrator; the fields that the configuration sets follow from it.
  const bool both = varies(field("configuration")) && varies(field("method"));
  axes_.push_back(both ? Axis{"integrator", integratorName} : field("method"));
  known.push_back(axes_.front());
  std::vector<Axis> others;
  if (!both) others.push_back(field("configuration"));
  for (const auto& other : specFields()) {
    const bool first = other.name == "scene" || other.name == "method" || other.name == "configuration";
    if (!first && !other.swept) others.push_back({other.name, other.get});
  }
  for (const auto& axis : others) {
    if (!varies(axis) || isDetermined(axis, known, specs_)) continue;
    axes_.push_back(axis);
    known.push_back(axis);
  }
}

void Block::findFamilies() {
  Cells methods;
  for (const auto& spec : specs_) addNew(methods, spec.method);
  for (const auto& method : methods) {
    if (findPeer(method) || isFamily(method)) continue;
    const auto tableau = makeTableau<double>(method);
    const std::string& id = tableau.family;
    const auto isPlain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    if (!std::all_of(id.begin(), id.end(), isPlain)) continue;  // no word for gnuplot
    auto at = std::find_if(families_.begin(), families_.end(), [&](const Family& family) { return family.id == id; });
    if (at == families_.end()) at = families_.insert(at, Family{id, {}});
    at->stages.insert(tableau.stages());
  }
}

FigureTable Block::start(const std::string& script, const std::string& title) const {
  return {.script = script,
          .name = {},
          .title = fmt::format("{}: {}", title, name_),
          .caption = {},
          .options = {},
          .place = {}};
}

// The combinations of these axes' values that occur, at most kMostFigures; one empty combination if there are no axes.
std::vector<Cells> Block::combinations(const std::vector<Axis>& axes) const {
  std::vector<Cells> all;
  for (const auto& spec : specs_) {
    const auto cells = cellsOf(axes, spec);
    if (std::find(all.begin(), all.end(), cells) == all.end()) all.push_back(cells);
    if (all.size() == kMostFigures) break;
  }
  return all;
}

std::vector<Axis> Block::besideMethods() const { return {axes_.begin() + 1, axes_.end()}; }

// Adds `only` to the figure and names its values in the title.
void choose(FigureTable& figure, const std::vector<Axis>& axes, const Cells& cells) {
  Cells only;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    only.push_back(axes[i].column + "=" + cells[i]);
    figure.title += ", " + only.back();
  }
  if (!only.empty()) figure.options.push_back({"only", only, FigureOption::Kind::kList});
}

FigureOption casesOf(const std::string& block, Cells scenes, std::size_t most) {
  if (scenes.size() > most) scenes.resize(most);
  for (auto& scene : scenes) scene = fmt::format("block={}:{}", block, scene);
  return {"cases", scenes, FigureOption::Kind::kList};
}

void Block::work(std::vector<FigureTable>& figures) const {
  const bool one_method = valuesOf(axes_.front(), specs_).size() == 1 && axes_.size() > 1;
  const std::size_t curves = one_method ? 1 : 0;
  std::vector<Axis> fixed = axes_;
  fixed.erase(fixed.begin(), fixed.begin() + static_cast<std::ptrdiff_t>(curves + 1));
  for (const auto& cells : combinations(fixed)) {
    auto figure = start("work_by", "Work and accuracy");
    figure.options = {
        {"variant", {axes_[curves].column}}, casesOf(name_, scenes_, kMostPanels), {"costs", {costColumn()}}};
    if (scenes_.size() > 2) figure.options.push_back({"columns", {"3"}, FigureOption::Kind::kNumber});
    choose(figure, fixed, cells);
    figure.caption = fmt::format("{} over the error reached; accuracy increases to the right, lower curves are {}.",
                                 study_.timing.wanted ? "CPU time" : "Residual evaluations",
                                 study_.timing.wanted ? "faster" : "cheaper");
    figures.push_back(std::move(figure));
  }
}

// The groups of components of a block's scene, position and velocity, state, multiplier.
Cells componentsOf(const RunSpec& spec) {
  const Sizes n = makeScene<double>(spec.scene, settingsAtStep(spec)).sizes();
  Cells components;
  if (n.nu > 0) components = {"u", "v"};
  if (n.nx > 0) components.emplace_back("x");
  if (n.nz > 0) components.emplace_back("z");
  return components;
}

void Block::errors(std::vector<FigureTable>& figures) const {
  Cells families;
  for (const auto& family : families_) families.push_back(family.id);
  if (families.empty()) return;
  for (const auto& scene : scenes_) {
    const auto spec = *std::find_if(specs_.begin(), specs_.end(), [&](auto& s) { return s.scene == scene; });
    const std::string component = componentsOf(spec).front();
    for (const auto& cells : combinations(besideMethods())) {
      auto figure = start("error_vs_step", "Error over step");
      figure.options = {blockOption(),
                        {"scene", {scene}},
                        {"component", {component}},
                        {"families", families, FigureOption::Kind::kList}};
      figure.title += ", " + scene;
      choose(figure, besideMethods(), cells);
      figure.caption = fmt::format("Fixed steps; error of {}.", component == "u" ? "the positions" : "the states");
      figures.push_back(std::move(figure));
    }
  }
}

void Block::orders(std::vector<FigureTable>& figures) const {
  // orders.csv names these settings only.
  for (const auto& axis : besideMethods()) {
    if (axis.column != "formulation" && axis.column != "settings") return;
  }
  for (const auto& scene : scenes_) {
    const auto spec = *std::find_if(specs_.begin(), specs_.end(), [&](auto& s) { return s.scene == scene; });
    for (const auto& cells : combinations(besideMethods())) {
      auto figure = start("order_vs_stages", "Observed order");
      figure.options = {
          blockOption(), {"scene", {scene}}, {"components", componentsOf(spec), FigureOption::Kind::kList}};
      figure.title += ", " + scene;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!cells[i].empty()) figure.options.push_back({axes_[i + 1].column, {cells[i]}});
        figure.title += fmt::format(", {}={}", axes_[i + 1].column, cells[i]);
      }
      figure.caption =
          "Line: theory, or the order that a tableau declares. Mark: slope of the error over the step; a "
          "red cross: it differs.";
      figures.push_back(std::move(figure));
    }
  }
}

void Block::costs(std::vector<FigureTable>& figures) const {
  constexpr std::size_t kCases = 3;
  if (axes_.size() > 1 || axes_.front().column != "method") return;
  for (const auto& family : families_) {
    if (family.stages.size() < kFewStages) continue;
    auto figure = start("cpu_vs_stages", "Cost at a fixed error over the number of stages");
    figure.title += ", " + family.id;
    figure.options = {casesOf(name_, scenes_, kCases), {"family", {family.id}}, {"cost", {costColumn()}}};
    figure.caption = "Cross: the error was not reached.";
    figures.push_back(std::move(figure));
  }
}

void Block::maps(std::vector<FigureTable>& figures) const {
  const bool several = std::any_of(families_.begin(), families_.end(),
                                   [](const Family& family) { return family.stages.size() >= kFewStages; });
  if (!several || levels_ < kFewStages || orders_ || axes_.front().column != "method") return;
  for (const auto& scene : scenes_) {
    for (const auto& cells : combinations(besideMethods())) {
      auto figure = start("failure_map", "Correct digits and failures");
      figure.options = {blockOption(), {"scene", {scene}}, {"y", {fixed_ ? "h" : "rtol"}}};
      figure.title += ", " + scene;
      choose(figure, besideMethods(), cells);
      figure.caption = "A mark without colour is a failed run.";
      figures.push_back(std::move(figure));
    }
  }
}

void Block::append(std::vector<FigureTable>& figures) const {
  if (fixed_) {
    errors(figures);
    if (has("orders")) orders(figures);
  } else {
    work(figures);
  }
  if (has("cost") && !orders_) costs(figures);
  maps(figures);
}

}  // namespace

void appendBlockFigures(const Study& study, const std::string& block, std::vector<FigureTable>& figures) {
  Block(study, block).append(figures);
}

}  // namespace irk
