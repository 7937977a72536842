#include "experiments/own/foreign/foreign_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "experiments/own/foreign/foreign_check.h"
#include "experiments/own/foreign/foreign_problem.h"
#include "experiments/own/foreign/guarded.h"
#include "irk/misuse.h"

namespace irk::own {
namespace {

using Model = std::shared_ptr<const ForeignModel>;

Component componentOf(const ForeignModel& model, Index i) {
  Component c{.name = "y" + std::to_string(i + 1)};
  if (!model.functions().component) return c;
  GuardedText name("irk_scene_component", c.name), unit("irk_scene_component");
  const double ones[] = {1.0};
  GuardedNumbers scale("irk_scene_component", "scale", 1, ones),
      rate_scale("irk_scene_component", "rate_scale", 1, ones);
  model.functions().component(model.self(), static_cast<int>(i), name.data(), unit.data(), scale.data(),
                              rate_scale.data());
  scale.requireInside();
  rate_scale.requireInside();
  return {name.text(), unit.text(), *scale.data(), *rate_scale.data()};
}

void setNames(const ForeignModel& model, Scene<double>& scene) {
  const Sizes& n = model.sizes();
  std::vector<Component> u, x, z;
  const auto guard = model.lock();
  for (Index i = 0; i < n.n(); ++i) (i < n.nu ? u : i < n.nu + n.nx ? x : z).push_back(componentOf(model, i));
  setComponents(scene, u, x, z);
  const auto& velocities = model.source().velocities;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const std::size_t at = u.size() + i;
    scene.names[at] = velocities[i].name;
    scene.units[at] = velocities[i].unit;
    scene.scale[static_cast<Index>(at)] = velocities[i].scale;
  }
}

void setStart(const ForeignModel& model, Scene<double>& scene) {
  scene.start = State<double>(model.sizes());
  State<double>& s = scene.start;
  if (!model.functions().start) return;
  const auto numbers = [](const char* name, Index n) {
    return GuardedNumbers("irk_scene_start", name, static_cast<std::size_t>(n),
                          std::vector<double>(static_cast<std::size_t>(n), 0));
  };
  const double interval[] = {0, 1};
  GuardedNumbers t("irk_scene_start", "t", 2, interval);
  GuardedNumbers y = numbers("y", model.layout().y), w = numbers("w", model.layout().w), d = numbers("d", s.d.size());
  {
    const auto guard = model.lock();
    model.functions().start(model.self(), t.data(), y.data(), w.data(), d.data());
  }
  for (const auto* written : {&t, &y, &w, &d}) {
    written->requireInside();
    written->requireFinite();
  }
  s.t = t.data()[0];
  scene.t_end = t.data()[1];
  if (!(scene.t_end >= s.t)) {
    throw Misuse(
        fmt::format("irk_scene_start: the end, t[1] = {:g}, lies before the start, t[0] = {:g}", scene.t_end, s.t));
  }
  const Index nu = s.u.size(), nx = s.x.size();
  const double* const from = y.data();
  std::copy_n(from, nu, s.u.data());
  std::copy_n(from + nu, nu, s.v.data());
  std::copy_n(from + 2 * nu, nx, s.x.data());
  std::copy_n(w.data(), nu + nx, s.w.data());
  std::copy_n(from + 2 * nu + nx, model.sizes().nz, s.w.data() + nu + nx);
  std::copy_n(d.data(), s.d.size(), s.d.data());
}

// Increments of differences are a part of these. A component may be far smaller than its typical magnitude, as a
// concentration is; t moves far less than the interval.
std::vector<double> magnitudesOf(const ForeignModel& model, const Scene<double>& scene) {
  constexpr double kPart = 1e-3;
  std::vector<double> all{kPart * (scene.t_end > scene.start.t ? scene.t_end - scene.start.t : 1)};
  for (Index i = 0; i < model.layout().y; ++i) all.push_back(kPart * scene.scale[i]);
  for (Index i = 0; i < model.layout().w; ++i) all.push_back(1);
  return all;
}

void setOutputs(const Model& model, Scene<double>& scene) {
  for (int i = 0; i < model->outputs(); ++i) {
    GuardedText name("irk_scene_output", "output" + std::to_string(i + 1)), unit("irk_scene_output");
    int invariant = 0;
    if (model->functions().output) {
      const auto guard = model->lock();
      model->functions().output(model->self(), i, name.data(), unit.data(), &invariant);
    }
    const auto value = [model, i](const State<double>& state) {
      const auto point = packed(model->layout(), pointOf(state));
      std::vector<double> values(static_cast<std::size_t>(model->outputs()));
      const auto guard = model->lock();
      model->functions().outputs(model->self(), point[0], model->layout().yOf(point.data()),
                                 model->layout().wOf(point.data()), state.d.data(), values.data());
      return values[static_cast<std::size_t>(i)];
    };
    scene.outputs.push_back({name.text(), value, unit.text(), invariant != 0});
  }
}

SceneKind kindOf(const ForeignModel& model) {
  const Sizes& n = model.sizes();
  if (n.constraints > 0) return SceneKind::kConstrained;
  if (n.nz == 0) return SceneKind::kOde;
  return model.algebraicIndex() == 2 ? SceneKind::kIndex2 : SceneKind::kIndex1;
}

// `torque.csv` or `torque.csv:M`: the first column is the time, and a column is called as the parameter, or M.
TimeTable<double> tableIn(const std::string& text, const std::string& parameter) {
  constexpr std::string_view kEnd = ".csv";
  const auto end = text.find(kEnd) + kEnd.size();
  if (end < text.size() && text[end] != ':') {
    throw Misuse(fmt::format("parameter {} = '{}': file.csv or file.csv:column is expected", parameter, text));
  }
  return {text.substr(0, end), "", end < text.size() ? text.substr(end + 1) : parameter};
}

ParameterValues valuesOfParameters(const ForeignSource& source, const Settings& settings) {
  ParameterValues values;
  for (const auto& parameter : source.parameters) {
    const std::string& text = settings.at(parameter.name);
    if (isTable(parameter, text)) {
      const TimeTable<double> table = tableIn(text, parameter.name);
      values.tables.emplace(values.numbers.size(), table);
      values.numbers.push_back(table(table.first()));
    } else {
      values.numbers.push_back(number<double>(settings, parameter.name));
    }
  }
  return values;
}

}  // namespace

Scene<double> foreignScene(const ForeignSource& source, const Settings& settings) {
  const auto model = std::make_shared<ForeignModel>(source, valuesOfParameters(source, settings));
  Scene<double> scene;
  setStart(*model, scene);
  setNames(*model, scene);
  model->setMagnitudes(magnitudesOf(*model, scene));
  setOutputs(model, scene);
  const auto point = packed(model->layout(), pointOf(scene.start));
  requireGoodFunctions(*model, {point.begin(), point.end()}, {scene.start.d.begin(), scene.start.d.end()});
  scene.system = [model = Model(model)](const SystemOptions& options) { return makeForeignSystem(model, options); };
  completeStart(scene);
  return scene;
}

SceneEntry foreignEntry(ForeignSource source, const std::string& id, const std::string& title) {
  SceneEntry entry;
  entry.id = id;
  entry.title = title.empty() ? "a scene in a shared library" : title;
  entry.shows = "a scene behind a C interface: numbers are double";
  entry.parameters = source.parameters;
  const auto kindOfDefaults = [&] {
    return kindOf(ForeignModel(source, valuesOfParameters(source, completedSettings(id, source.parameters, {}))));
  };
  entry.kind = source.kind ? *source.kind : kindOfDefaults();
  entry.make = [source = std::move(source)](const Settings& settings) { return foreignScene(source, settings); };
  return entry;
}

std::string idFromFile(const std::string& stem) {
  std::string id;
  for (const char letter : stem) {
    const auto code = static_cast<unsigned char>(letter);
    id += std::isalnum(code) != 0 && code < 128 ? static_cast<char>(std::tolower(code)) : '_';
  }
  return id;
}

}  // namespace irk::own
