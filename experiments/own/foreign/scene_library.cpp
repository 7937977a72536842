#include "experiments/own/foreign/scene_library.h"

#include <fmt/format.h>

#include <memory>
#include <vector>

#include "core/base/number_text.h"
#include "experiments/own/crash.h"
#include "experiments/own/foreign/foreign_scene.h"
#include "experiments/own/foreign/guarded.h"
#include "experiments/own/shared_library.h"
#include "irk/misuse.h"

namespace irk::own {
namespace {

using Library = std::shared_ptr<const SharedLibrary>;

SceneFunctions functionsOf(const SharedLibrary& library) {
  SceneFunctions f;
  const auto find = [&library]<class F>(F*& function, const char* name) { function = library.find<F>(name); };
  find(f.close, "irk_scene_close");
  find(f.size, "irk_scene_size");
  find(f.component, "irk_scene_component");
  find(f.start, "irk_scene_start");
  find(f.rates, "irk_scene_rates");
  find(f.residual, "irk_scene_residual");
  find(f.mass, "irk_scene_mass");
  find(f.constraints, "irk_scene_constraints");
  find(f.jacobian, "irk_scene_jacobian");
  find(f.entries, "irk_scene_entries");
  find(f.product, "irk_scene_product");
  find(f.switching, "irk_scene_switching");
  find(f.switch_name, "irk_scene_switch_name");
  find(f.on_switch, "irk_scene_on_switch");
  find(f.jump, "irk_scene_jump");
  find(f.times, "irk_scene_times");
  find(f.on_time, "irk_scene_on_time");
  find(f.jump_at_time, "irk_scene_jump_at_time");
  find(f.output, "irk_scene_output");
  find(f.outputs, "irk_scene_outputs");
  return f;
}

void requireConsistent(const SceneFunctions& f) {
  if (!f.size) throw Misuse("it has no function 'irk_scene_size'");
  if (!f.rates && !f.residual) throw Misuse("it has neither irk_scene_rates nor irk_scene_residual");
  if (f.rates && f.residual) throw Misuse("it has both irk_scene_rates and irk_scene_residual: one is expected");
  if (f.mass && f.residual) {
    throw Misuse("it has irk_scene_mass, which belongs to irk_scene_rates: the rows of irk_scene_residual hold M");
  }
  if (f.jacobian && f.product) throw Misuse("it has both irk_scene_jacobian and irk_scene_product: one is expected");
}

std::vector<Parameter> parametersOf(const SharedLibrary& library) {
  std::vector<Parameter> all;
  auto* const parameter = library.find<decltype(irk_scene_parameter)>("irk_scene_parameter");
  constexpr int kMost = 100'000;
  for (int i = 0; parameter; ++i) {
    GuardedText name("irk_scene_parameter"), unit("irk_scene_parameter"), meaning("irk_scene_parameter");
    const double none[] = {0, -1e300, 1e300};
    GuardedNumbers range("irk_scene_parameter", "range", 3, none);
    if (parameter(i, name.data(), unit.data(), meaning.data(), range.data()) == 0) break;
    if (i == kMost) throw Misuse(fmt::format("irk_scene_parameter: it never returns 0, also not for i = {}", kMost));
    range.requireInside();
    const double* const numbers = range.data();
    all.push_back(
        numberParameter(name.text(), unit.text(), meaning.text(), numberText(numbers[0]), numbers[1], numbers[2]));
  }
  return all;
}

SceneEntry entryIn(const Library& library) {
  const int version = library->get<decltype(irk_scene_version)>("irk_scene_version")();
  if (version != IRK_SCENE_VERSION) {
    throw Misuse(fmt::format("irk_scene_version() = {}: this program has version {} of irk/scene_c.h", version,
                             IRK_SCENE_VERSION));
  }
  ForeignSource source;
  source.functions = functionsOf(*library);
  requireConsistent(source.functions);
  source.derivatives = source.functions.jacobian ? "irk_scene_jacobian" : "irk_scene_product";
  source.parameters = parametersOf(*library);
  source.one_at_a_time = {library, &library->oneAtATime()};
  auto* const open = library->find<decltype(irk_scene_open)>("irk_scene_open");
  if (!open && !source.parameters.empty()) throw Misuse("it has parameters, but no function irk_scene_open");
  if (open) {
    source.open = [library, open](const ParameterValues& values, void** self, char* message) {
      return open(values.numbers.data(), self, message);
    };
  }
  GuardedText title("irk_scene_title");
  auto* const write_title = library->find<decltype(irk_scene_title)>("irk_scene_title");
  if (write_title) write_title(title.data());
  const std::string file = library->path().filename().string();
  return foreignEntry(std::move(source), idFromFile(file.substr(0, file.find(".so"))), title.text());
}

}  // namespace

bool holdsScene(const std::filesystem::path& library) {
  return SharedLibrary(library).find<decltype(irk_scene_version)>("irk_scene_version") != nullptr;
}

LibraryScene sceneOfLibrary(const std::filesystem::path& path) {
  const auto library = std::make_shared<const SharedLibrary>(path);
  explainCrashes(path);
  const TableReadings readings(path.parent_path().string());
  try {
    return {entryIn(library), library->hash()};
  } catch (const Misuse& misuse) {
    const std::string text = misuse.what();
    if (text.starts_with(path.string())) throw;
    library->refuse(text);
  }
}

}  // namespace irk::own
