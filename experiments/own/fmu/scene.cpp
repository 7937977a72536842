#include "experiments/own/fmu/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/base/number_text.h"
#include "experiments/own/crash.h"
#include "experiments/own/fmu/run.h"
#include "experiments/own/foreign/foreign_scene.h"
#include "irk/misuse.h"

namespace irk::own {
namespace {

FmuRun& runOf(void* self) { return *static_cast<FmuRun*>(self); }
const FmuDescription& descriptionOf(void* self) { return runOf(self).model().fmu.description; }

// Longer texts are cut.
void put(const std::string& text, char* to) {
  const std::size_t size = std::min<std::size_t>(text.size(), IRK_SCENE_TEXT - 1);
  std::transform(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(size), to,
                 [](char letter) { return letter == '\n' || letter == '\t' ? ' ' : letter; });
  to[size] = '\0';
}

void describe(SceneFunctions& f) {
  f.close = [](void* self) { delete &runOf(self); };
  f.size = [](void* self, irk_scene_sizes* n) {
    const FmuModel& model = runOf(self).model();
    n->nu = static_cast<int>(model.nu);
    n->nx = static_cast<int>(model.nx);
    runOf(self).begin();
    n->discrete = 1;
    n->switches = static_cast<int>(runOf(self).switches());
    n->outputs = static_cast<int>(model.fmu.description.outputs.size());
    n->concurrent = 1;  // FmuRun lets threads wait itself
  };
  f.component = [](void* self, int i, char* name, char* unit, double* scale, double* rate_scale) {
    const FmuModel& model = runOf(self).model();
    const auto& states = model.fmu.description.states;
    const auto k = static_cast<std::size_t>(i);
    const FmuVariable& state = states[model.order[k < model.nu ? k : k + model.nu]];
    put(state.name, name);
    put(state.unit, unit);
    *scale = state.nominal;
    *rate_scale = state.nominal;
  };
  f.start = [](void* self, double* t, double* y, double*, double*) {
    t[0] = descriptionOf(self).start;
    t[1] = descriptionOf(self).stop;
    runOf(self).start(y);
  };
  f.output = [](void* self, int i, char* name, char* unit, int*) {
    const FmuVariable& output = descriptionOf(self).outputs[static_cast<std::size_t>(i)];
    put(output.name, name);
    put(output.unit, unit);
  };
  f.outputs = [](void* self, double t, const double* y, const double*, const double* d, double* values) {
    const std::size_t count = descriptionOf(self).outputs.size();
    if (!runOf(self).outputs(t, y, d[0], values)) std::fill_n(values, count, std::numeric_limits<double>::quiet_NaN());
  };
}

void evaluate(SceneFunctions& f, const FmuDescription& fmu) {
  f.rates = [](void* self, double t, const double* y, const double* d, double* to) {
    return runOf(self).rates(t, y, d[0], to) ? 0 : 1;
  };
  if (fmu.directional_derivatives) {
    f.product = [](void* self, double t, const double* y, const double*, const double* d, const double* dy,
                   const double*, double* dr) { return runOf(self).product(t, y, d[0], dy, dr) ? 0 : 1; };
  }
  f.switching = [](void* self, double t, const double* y, const double*, const double* d, double* g) {
    return runOf(self).switching(t, y, d[0], g) ? 0 : 1;
  };
  f.switch_name = [](void* self, int i, char* name) {
    const bool in_time = static_cast<std::size_t>(i) + 1 == runOf(self).switches();
    put(in_time ? "time" : fmt::format("indicator{}", i), name);
  };
  f.on_switch = [](void* self, int i, double t, const double* y, const double*, double* d) {
    d[0] = runOf(self).event(static_cast<std::size_t>(i), t, y, d[0]);
  };
  f.jump = [](void* self, int, double, double* y, const double* d) { runOf(self).jump(d[0], y); };
  if (!fmu.steps_completed) return;
  f.complete_step = [](void* self, double t, double* y, double* d) { return runOf(self).completeStep(t, y, *d); };
}

Parameter parameterOf(const FmuVariable& v) {
  const std::string start = v.start == "true" ? "1" : v.start == "false" ? "0" : v.start;
  const double value = std::strtod(start.c_str(), nullptr);
  // A default beyond its own bounds is the FMU's matter.
  Parameter p =
      numberParameter(v.name, v.unit, v.meaning, numberText(value), std::min(v.min, value), std::max(v.max, value));
  p.whole = v.type != FmuType::kReal;
  if (v.type == FmuType::kBoolean) p.min = 0, p.max = 1;
  p.table = v.input;
  return p;
}

ForeignSource sourceOf(const std::shared_ptr<const FmuModel>& model) {
  ForeignSource source;
  const FmuDescription& fmu = model->fmu.description;
  source.derivatives = "its directional derivatives are no derivatives of its rates";
  describe(source.functions);
  evaluate(source.functions, fmu);
  source.kind = SceneKind::kOde;
  source.open = [model](const ParameterValues& values, void** self, char*) {
    *self = new FmuRun(model, values);  // deleted by `close`
    return 0;
  };
  for (const auto& variable : fmu.settable) source.parameters.push_back(parameterOf(variable));
  for (std::size_t i = 0; i < model->nu; ++i) {
    const FmuVariable& v = fmu.states[model->order[model->nu + i]];
    source.velocities.push_back({v.name, v.unit, v.nominal});
  }
  return source;
}

}  // namespace

LibraryScene sceneOfFmu(const std::filesystem::path& file) {
  const auto model = loadFmu(file);
  explainCrashes(file);
  const FmuDescription& fmu = model->fmu.description;
  try {
    const std::string title = fmt::format("FMU {}.0 of the model {}", fmu.version, fmu.name);
    return {foreignEntry(sourceOf(model), idFromFile(file.stem().string()), title), model->hash};
  } catch (const Misuse& misuse) {
    throw Misuse(file.string() + ": " + misuse.what());
  }
}

}  // namespace irk::own
