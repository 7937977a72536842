// What `irk reference` integrates, and how.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/runs/run_spec.h"

namespace irk {

/// One scene with one set of parameters. Every task is integrated by two methods with two
/// tolerances each, in 50 digits, its switches located.
struct ReferenceTask {
  std::string scene;
  ReferenceCase of = {};
  Formulation formulation = Formulation::kIndex2;
  std::string_view second = "lobatto_iiic_16";  ///< beside radau_iia_16
};

/// The finer tolerance over the coarser one.
inline constexpr double kFiner = 1e-3;

/// The reference cases of all scenes, those of a scene one after the other.
std::vector<ReferenceTask> referenceTasks();

enum class Fineness { kCoarse, kFine };

/// The run with `method` and one of the two tolerances (or steps), to the scene's end.
RunSpec referenceSpec(const ReferenceTask& task, std::string_view method, Fineness fineness);

}  // namespace irk
