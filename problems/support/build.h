// Helpers for scene files: parameters from settings, names, systems, consistent starts. Internal.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "irk/scene.h"

namespace irk {

/// A number with unit and range [min, max]. The default may be a word ("inf", "vb") that the scene itself
/// interprets; this word is then allowed as a value, too.
Parameter numberParameter(std::string name, std::string unit, std::string meaning, std::string default_value,
                          double min, double max);

/// A positive physical quantity, at most 1e15.
Parameter positiveParameter(std::string name, std::string unit, std::string meaning, std::string default_value);

/// The width over which a regularised scene blends its modes. It has an effect with discontinuity `smooth` only.
Parameter smoothingParameter(std::string unit, std::string meaning, std::string default_value);

/// The number of finite elements, an integer.
Parameter elementsParameter(std::string default_value);

/// A choice among words, the default first.
Parameter wordParameter(std::string name, std::string meaning, std::vector<std::string> choices);

/// Returns the settings completed with defaults. Throws Misuse unless every setting names a parameter and lies within
/// its range.
Settings completedSettings(std::string_view scene, const std::vector<Parameter>& parameters, const Settings& given);

/// A completed setting as a number, with all digits of its text.
template <class Real>
Real number(const Settings& settings, const std::string& name);

/// A constant of the scene with all digits of its decimal text: decimal<Real>("3.1415927").
template <class Real>
Real decimal(const char* text);

template <class Real>
Real piOf();

/// A component of u, x or z. The time derivative of a component of u gets the same name with a prime.
struct Component {
  std::string name;
  std::string unit = {};  ///< empty: none
  double scale = 1;       ///< typical magnitude
  double rate_scale = 1;  ///< typical magnitude of the time derivative; for u only
};

/// Sets scene.names, units and scale. If scene.time_unit is not s, set it before this call.
template <class Real>
void setComponents(Scene<Real>& scene, const std::vector<Component>& u, const std::vector<Component>& x = {},
                   const std::vector<Component>& z = {});

/// Tolerances for ReferenceCase: many digits for cheap scenes, few for thousands of elastic oscillations.
inline constexpr double kManyDigits = 1e-28, kFewDigits = 1e-19;

/// Sets scene.system from a problem struct, which is copied, and scene.start to zeros of its sizes.
template <class Real, class P>
void setProblem(Scene<Real>& scene, P problem) {
  scene.start = State<Real>(problem.sizes());
  scene.system = [problem = std::move(problem)](const SystemOptions& options) {
    return makeSystem<Real>(problem, options);
  };
}

/// Computes start.w = (a, k, z) from start.u, v, x. Throws std::logic_error if the start is not consistent, which is
/// a mistake in the scene.
template <class Real>
void completeStart(Scene<Real>& scene);

}  // namespace irk
