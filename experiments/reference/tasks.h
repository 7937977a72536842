// What `irk reference` integrates, and how.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "experiments/runs/run_spec.h"

namespace irk {

/// One scene with one set of parameters. Every task is integrated by two methods with two
/// tolerances each, in 50 digits, its switches located.
struct ReferenceTask {
  std::string_view scene;
  std::string_view settings;  ///< `name=value name=value`
  std::string_view times;     ///< decimal, ascending, besides the scene's end
  double tolerance = 1e-25;   ///< rtol and atol; the finer one is kFiner of it
  Formulation formulation = Formulation::kIndex2;
  std::string_view second = "lobatto_iiic_16";  ///< beside radau_iia_16
  NewtonKind newton = NewtonKind::kSimplified;
  /// > 0: fixed steps of this size and of half of it instead of the two tolerances.
  double step = 0;
};

/// The finer tolerance over the coarser one.
inline constexpr double kFiner = 1e-3;

/// All tasks, those of a scene one after the other, at least one with default settings per scene.
std::span<const ReferenceTask> referenceTasks();

enum class Fineness { kCoarse, kFine };

/// The run with `method` and one of the two tolerances (or steps), to the scene's end.
RunSpec referenceSpec(const ReferenceTask& task, std::string_view method, Fineness fineness);

}  // namespace irk
