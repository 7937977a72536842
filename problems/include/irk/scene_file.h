// What a scene's file needs: parameters from settings, names, systems, consistent starts, and IRK_SCENE.
//
// A scene outside the tree is one file. It is a struct template over the scalar, a problem as in irk/problem.h, with
// two more functions:
//
//   template <class Real>
//   struct FourBar {
//     static SceneEntry entry();                       // id, title, parameters, ...; without its makers
//     static Scene<Real> make(const Settings& values);  // with the parameters' values
//     ...
//   };
//   IRK_SCENE(FourBar)
//
// `irk new scene four_bar.cpp` writes a complete one. The program compiles such a file when it is named
// (`irk solve four_bar.cpp`). The same file linked with irk::program is a program with all verbs, which knows the
// scene.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "irk/registration.h"
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

/// Any text, such as the name of a file with measured data; without blanks and ';'.
Parameter textParameter(std::string name, std::string meaning, std::string default_value);

/// Returns the settings completed with defaults. Throws Misuse unless every setting names a parameter and lies within
/// its range.
Settings completedSettings(std::string_view scene, const std::vector<Parameter>& parameters, const Settings& given);

/// A completed setting as a number, with all digits of its text. Throws Misuse for a parameter that the entry lacks.
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

/// Sets scene.system from a problem struct, which is copied, and scene.start to zeros of its sizes: to be called before
/// the start is filled. Throws Misuse for sizes that cannot be.
template <class Real, class P>
void setProblem(Scene<Real>& scene, P problem) {
  scene.start = State<Real>(makeSystem<Real>(problem)->sceneSizes());
  scene.system = [problem = std::move(problem)](const SystemOptions& options) {
    return makeSystem<Real>(problem, options);
  };
}

/// Computes start.w = (a, k, z) from start.u, v, x. Throws Misuse if the start is not consistent, which is a mistake in
/// the scene.
template <class Real>
void completeStart(Scene<Real>& scene);

/// The same for a start that is known in part: first changes the components of u and v with these names (as
/// setComponents names them: "phi", "phi'") such that the position constraints g(t, u) = 0 and their derivatives
/// dg/dt = 0 hold; their values in start.u and start.v are first guesses. Gauss-Newton steps, the least change where
/// more components are named than needed. Throws Misuse for an unknown name, and where the constraints cannot be met.
template <class Real>
void completeStart(Scene<Real>& scene, const std::vector<std::string>& unknown);

/// The entry of a scene's struct with the makers of the scalars that this file is compiled for: double and mp50, or
/// with IRK_DIGITS set to 16, 50 or 100 the one that it names.
template <template <class> class S>
SceneEntry sceneEntryOf() {
  SceneEntry entry = S<double>::entry();
#if !defined(IRK_DIGITS) || IRK_DIGITS == 16
  entry.make = S<double>::make;
#endif
#if !defined(IRK_DIGITS) || IRK_DIGITS == 50
  entry.make_mp50 = S<mp50>::make;
#endif
#if defined(IRK_DIGITS) && IRK_DIGITS == 100
  entry.make_mp100 = S<mp100>::make;
#endif
  return entry;
}

}  // namespace irk

/// Makes the struct template S a scene of the program. One per file.
#ifdef IRK_DIGITS
#define IRK_SCENE(S) \
  extern "C" void irk_scene(::irk::SceneEntry* entry) { *entry = ::irk::sceneEntryOf<S>(); }
#else
#define IRK_SCENE(S) \
  IRK_REGISTER { ::irk::registerScene(::irk::sceneEntryOf<S>()); }
#endif
