// The integrations of `irk reference`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/runs/run_spec.h"

namespace irk {

/// One scene with one set of parameters. Every task is integrated in 50 digits with switches located, by two methods
/// with two tolerances each.
struct ReferenceTask {
  std::string scene;
  ReferenceCase of = {};
  Formulation formulation = Formulation::kIndex2;
  std::string_view second = "lobatto_iiic_16";  ///< the other method is radau_iia_16
};

/// Ratio of the finer tolerance to the coarser one.
inline constexpr double kFiner = 1e-3;

/// The reference cases of all scenes, grouped by scene.
std::vector<ReferenceTask> referenceTasks();

enum class Fineness { kCoarse, kFine };

/// The run with `method` and one of the two tolerances (or steps), up to the scene's end.
RunSpec referenceSpec(const ReferenceTask& task, std::string_view method, Fineness fineness);

}  // namespace irk
