#include "experiments/runs/references/made_reference.h"

#include "experiments/base/decimal.h"
#include "experiments/runs/run_errors.h"
#include "experiments/runs/setup.h"

namespace irk {

bool needsReference(const RunSpec& resolved) {
  if (resolved.reference != ReferenceUse::kAuto || resolved.options.steady > 0) return false;
  if (!resolved.options.stop_at.empty()) return true;
  const auto scene = sceneOf<double>(resolved);
  if (resolved.discontinuity == Discontinuity::kSmooth && scene.sizes().switches > 0) return true;
  State<double> end = scene.start;  // only its time matters: which components are known there
  end.t = resolved.t_end;
  const auto stored = references(resolved.scene, settingsAtStep(resolved));
  return errorsOf(scene, stored, end).reference == ReferenceKind::kNone;
}

RunSpec endingAt(RunSpec resolved, double t) {
  if (!resolved.options.stop_at.empty() || resolved.options.steady == 0) return resolved;
  resolved.options.steady = 0;
  resolved.t_end = t;
  return resolved;
}

std::vector<RunSpec> atReferenceTimes(const RunSpec& resolved) {
  std::vector<RunSpec> runs(static_cast<std::size_t>(resolved.reference_times), resolved);
  for (int k = 1; k < resolved.reference_times; ++k) {
    runs[static_cast<std::size_t>(k - 1)].t_end = resolved.t_end * k / resolved.reference_times;
  }
  return runs;
}

}  // namespace irk
