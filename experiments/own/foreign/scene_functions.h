// A scene behind the interface irk/scene_c.h: its functions, and where it comes from.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "irk/scene.h"
#include "irk/scene_c.h"
#include "irk/scene_file.h"

namespace irk::own {

/// Null where the scene has no such function.
struct SceneFunctions {
  decltype(irk_scene_close)* close = nullptr;
  decltype(irk_scene_size)* size = nullptr;
  decltype(irk_scene_component)* component = nullptr;
  decltype(irk_scene_start)* start = nullptr;
  decltype(irk_scene_rates)* rates = nullptr;
  decltype(irk_scene_residual)* residual = nullptr;
  decltype(irk_scene_mass)* mass = nullptr;
  decltype(irk_scene_constraints)* constraints = nullptr;
  decltype(irk_scene_jacobian)* jacobian = nullptr;
  decltype(irk_scene_entries)* entries = nullptr;
  decltype(irk_scene_product)* product = nullptr;
  decltype(irk_scene_switching)* switching = nullptr;
  decltype(irk_scene_switch_name)* switch_name = nullptr;
  decltype(irk_scene_on_switch)* on_switch = nullptr;
  decltype(irk_scene_jump)* jump = nullptr;
  decltype(irk_scene_times)* times = nullptr;
  decltype(irk_scene_on_time)* on_time = nullptr;
  decltype(irk_scene_jump_at_time)* jump_at_time = nullptr;
  decltype(irk_scene_output)* output = nullptr;
  decltype(irk_scene_outputs)* outputs = nullptr;
  /// Of FMUs: called with the end of each accepted step that no switch has ended. Returns whether the step asks for
  /// another mode; then changes d, and y where it jumps (System::completeStep).
  bool (*complete_step)(void* self, double t, double* y, double* d) = nullptr;
};

/// The values of a scene's parameters, in their order. Where one is a table, the number is its value at the first row.
struct ParameterValues {
  std::vector<double> numbers;
  std::map<std::size_t, TimeTable<double>> tables;  ///< by the parameter's number
};

/// What scenes with any values of the parameters have in common.
struct ForeignSource {
  SceneFunctions functions;
  /// As irk_scene_open; empty if scenes have no `self`. It keeps the library loaded.
  std::function<int(const ParameterValues& values, void** self, char* message)> open;
  std::vector<Parameter> parameters;
  /// Held during each call unless the scene is concurrent.
  std::shared_ptr<std::mutex> one_at_a_time = std::make_shared<std::mutex>();
  /// Known without opening a scene; else the sizes tell it.
  std::optional<SceneKind> kind = {};
  /// What derivatives are called in messages.
  std::string derivatives = {};
  /// Names, units and magnitudes of v where they are not those of u' (setComponents): an FMU names its states.
  std::vector<Component> velocities = {};
};

}  // namespace irk::own
