// The runs of an audit: drawn at random from the catalogues, the same for the same seed.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>

#include "experiments/runs/run_spec.h"
#include "experiments/study/study.h"

namespace irk::audit {

/// The treatment of switches is the spec's default.
inline constexpr const char* kDefaultTreatment = "default";
/// The scene has no switches.
inline constexpr const char* kNoSwitches = "no switches";

struct DrawnRun {
  RunSpec spec;           ///< resolved
  std::string treatment;  ///< kDefaultTreatment, kNoSwitches, or the id of a Discontinuity
};

/// `options.runs` legal runs, made on demand. Run i depends only on the seed and on i, so that a shorter audit is the
/// beginning of a longer one. Values that a run leaves at their defaults are not drawn: after a change of a default the
/// same runs are drawn, with the new default.
///
/// Scenes are drawn with equal probability from options.scenes or, if that is empty, from the scenes of the library
/// (never from those of users). Then follow the settings (half of the time the defaults, else one of `options.variants`
/// drawn variants, half of which also end at another time), configuration or another library's integrator, treatment
/// of switches, formulation, method, rtol and atol, and options of the solver (drawn/options.h). A combination that is
/// refused is drawn again. Of each run but those of other libraries the error bar is measured; some with a closed form
/// are also judged on the way (reference_times). Thread-safe.
class Draw {
 public:
  /// Throws Misuse for an unknown scene.
  explicit Draw(const AuditOptions& options);
  ~Draw();

  std::size_t size() const { return size_; }
  DrawnRun operator[](std::size_t i) const;

 private:
  class Drawer;
  std::size_t size_;
  std::unique_ptr<Drawer> drawer_;
  mutable std::mutex mutex_;
};

/// Variant i of the scene's settings. Each number with a default other than 0 is multiplied by 4^x, x uniform in [-1,
/// 1], clipped to its range and rounded to three digits; words are drawn among the choices; integers stay small. The
/// foreign scenes have ranges for this purpose: a number is drawn from its whole range, uniform in its logarithm.
/// Regularization parameters differ from their defaults only with the treatment `smooth`. Variants of which no scene
/// can be made are drawn again.
Settings drawnSettings(const SceneEntry& scene, std::uint64_t seed, Index variant, Discontinuity treatment);

}  // namespace irk::audit
