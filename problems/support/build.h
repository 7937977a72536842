// What scene files share: parameters from settings, names, systems, consistent starts. Internal.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "irk/scene.h"

namespace irk {

/// A number with unit and range. The default may be a word ("inf", "vb") that only the scene
/// understands; it is then allowed as a value, too.
Parameter numberParameter(std::string name, std::string unit, std::string meaning,
                          std::string default_value, double min, double max);

/// A positive physical quantity: (0, 1e15].
Parameter positiveParameter(std::string name, std::string unit, std::string meaning,
                            std::string default_value);

/// Over how much a regularised scene blends its modes; of effect in the mode `smooth` only.
Parameter smoothingParameter(std::string unit, std::string meaning, std::string default_value);

/// A whole number of finite elements.
Parameter elementsParameter(std::string default_value);

/// A choice among words, the default first.
Parameter wordParameter(std::string name, std::string meaning, std::vector<std::string> choices);

/// Throws Misuse unless every setting names a parameter and lies in its range; adds the defaults.
Settings completedSettings(std::string_view scene, const std::vector<Parameter>& parameters,
                           const Settings& given);

/// A completed setting as a number, with all digits of its text.
template <class Real>
Real number(const Settings& settings, const std::string& name);

/// A constant of the scene with all digits of its decimal text: decimal<Real>("3.1415927").
template <class Real>
Real decimal(const char* text);

template <class Real>
Real piOf();

/// A component of u, x or z. The time derivative of one of u is named with a prime.
struct Component {
  std::string name;
  std::string unit = {};  ///< empty: none
  double scale = 1;       ///< typical magnitude
  double rate_scale = 1;  ///< of the time derivative, for u
};

/// Sets scene.names, units and scale. scene.time_unit is set before, where it is not s.
template <class Real>
void setComponents(Scene<Real>& scene, const std::vector<Component>& u, const std::vector<Component>& x = {},
                   const std::vector<Component>& z = {});

/// Tolerances of ReferenceCase: what is cheap gets many digits; thousands of elastic oscillations get few.
inline constexpr double kManyDigits = 1e-28, kFewDigits = 1e-19;

/// scene.system from a problem struct; scene.start with its sizes, all zero.
template <class Real, class P>
void setProblem(Scene<Real>& scene, P problem) {
  scene.start = State<Real>(problem.sizes());
  scene.system = [problem = std::move(problem)](const SystemOptions& options) {
    return makeSystem<Real>(problem, options);
  };
}

/// Sets start.w = (a, k, z) from start.u, v, x. Throws std::logic_error if the scene's start is not
/// consistent.
template <class Real>
void completeStart(Scene<Real>& scene);

}  // namespace irk
