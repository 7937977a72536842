// The runs of an audit: drawn at random from the catalogues, the same for the same seed.
#pragma once

#include <string>
#include <vector>

#include "experiments/runs/run_spec.h"
#include "experiments/study/study.h"

namespace irk::audit {

/// The treatment of switches was left to the spec's default.
inline constexpr const char* kDefaultTreatment = "default";
/// The scene declares no switches: there is nothing to treat.
inline constexpr const char* kNoSwitches = "no switches";

struct DrawnRun {
  RunSpec spec;           ///< resolved
  std::string treatment;  ///< kDefaultTreatment, kNoSwitches, or the id of a Discontinuity
};

/// `options.runs` legal runs. Run i depends on the seed and i alone, so that a shorter audit is the
/// beginning of a longer one. What a run leaves to a default is no part of the draw: after a change
/// of the defaults the same runs are drawn, but for that default.
///
/// Scenes are drawn with equal chance; then settings (the defaults half of the time, else one of
/// `options.variants` drawn variants of the scene), configuration, treatment of switches,
/// formulation, method and tolerance. A combination that is refused is drawn again.
std::vector<DrawnRun> drawnRuns(const AuditOptions& options);

/// Variant i of the scene's settings: each number with a default other than 0 is multiplied by 4^x, x
/// uniform in [-1, 1], clipped to its range and rounded to three digits; words are drawn among the
/// choices; whole numbers stay small. Parameters of the regularisation differ from their defaults in
/// `smooth` only. Variants that no scene can be made of are drawn again.
Settings drawnSettings(const SceneEntry& scene, std::uint64_t seed, Index variant,
                       Discontinuity treatment);

/// `irk solve ...`, the command that repeats the run.
std::string commandOf(const DrawnRun& run);

}  // namespace irk::audit
