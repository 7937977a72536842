// The integrations of `irk reference`.
#pragma once

#include <cstddef>
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
  std::string_view second = "lobatto_iiic_16";  ///< the other method is kFirstMethod
};

/// Ratio of the finer tolerance to the coarser one.
inline constexpr double kFiner = 1e-3;

/// The reference cases of all scenes, grouped by scene. A registered scene without any has its parameters' defaults
/// and its end.
std::vector<ReferenceTask> referenceTasks();

enum class Fineness { kCoarse, kFine };

/// The run with `method` and one of the two tolerances (or steps), up to the scene's end.
RunSpec referenceSpec(const ReferenceTask& task, std::string_view method, Fineness fineness);

inline constexpr std::string_view kFirstMethod = "radau_iia_16";
inline constexpr std::size_t kReferenceRuns = 4;
/// The four runs of a task: run < kReferenceRuns; the last one is the best and takes longest.
RunSpec referenceRun(const ReferenceTask& task, std::size_t run);

}  // namespace irk
