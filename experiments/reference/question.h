// The question that a computed reference answers: a scene with its settings, at the end of a run.
#pragma once

#include <string>
#include <vector>

#include "experiments/runs/run_spec.h"

namespace irk {

/// Runs with equal questions share one reference.
struct ReferenceQuestion {
  std::string scene;
  Settings settings;  ///< without defaults; values over h are those of the run's step
  double t_end = 0;
  bool smooth = false;       ///< the regularized problem, which has another solution
  std::string stop_at = {};  ///< the switch at which the runs end; t_end is then how far they may go
};

ReferenceQuestion referenceQuestion(const RunSpec& resolved);

/// Everything that determines the reference, as one text: scene, the scene's source and tables, all settings with their
/// defaults, t_end, stop_at, whether the problem is the regularized one, and the code of this program. The hash of this
/// text names the file in the cache. Throws Misuse as makeScene.
std::string keyText(const ReferenceQuestion& question);

/// For messages: `slider_crank torque_off_at=0.5 smooth, t = 1`; of several that differ in t_end only, ascending,
/// `kepler, t = 0.1 ... 1 (10 times)`.
std::string placeText(const ReferenceQuestion& question);
std::string placeText(const std::vector<ReferenceQuestion>& questions);

/// A hash of the user's file from which the scene is made. Empty for scenes of the program, whose code is in the
/// fingerprint of the build.
std::string sourceOf(const SceneEntry& scene);

}  // namespace irk
