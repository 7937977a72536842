// What a scene's file needs: parameters from settings, names, systems, consistent starts, and IRK_SCENE.
//
// A scene is a struct template over the scalar: a problem as in irk/problem.h, and what the program needs besides the
// equations. Scenes of the suite and of users have the same form:
//
//   using namespace irk;
//
//   namespace {  // names of this file only: other scenes may use the same ones
//
//   template <class Real>
//   struct FourBar {
//     ...                                             // constants, sizes, equations
//     static FourBar with(const Settings& values);    // the problem with these parameters; only if it has some
//     void start(State<Real>& s) const;               // fills t, u, v, x, d where they are not 0, and guesses of z
//     State<Real> exact(const Real& t) const;         // the exact solution, if it is known
//     SceneFrame<Real> frame() const;                 // end, names, units
//     static SceneEntry entry();                      // id, title, parameters, ...
//   };
//
//   }  // namespace
//
//   IRK_SCENE(FourBar)
//
// Such a file outside the tree is complete: `irk new scene four_bar.cpp` writes one. The program compiles it when it is
// named (`irk solve four_bar.cpp`). The same file linked with irk::program is a program with all verbs, which knows the
// scene. A struct may instead make its scene itself: `static Scene<Real> make(const Settings& values)` replaces `with`,
// `start`, `exact` and `frame`. Scenes need it that have several sets of coordinates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
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

/// A whole number, such as a number of unknowns. The audit draws values up to `audit_max` only, which keeps its runs
/// short.
Parameter wholeParameter(std::string name, std::string meaning, std::string default_value, double min, double max,
                         double audit_max);

/// The width over which a regularised scene blends its modes. It has an effect with discontinuity `smooth` only.
Parameter smoothingParameter(std::string unit, std::string meaning, std::string default_value);

/// The number of finite elements, an integer.
Parameter elementsParameter(std::string default_value);

/// A choice among words, the default first. Throws Misuse for no words.
Parameter wordParameter(std::string name, std::string meaning, std::vector<std::string> choices);

/// A choice among descriptions of the same physics, such as sets of coordinates: the solution is the same with each.
Parameter descriptionParameter(std::string name, std::string meaning, std::vector<std::string> choices);

/// Any text, such as the name of a file with measured data; without blanks and ';'.
Parameter textParameter(std::string name, std::string meaning, std::string default_value);

/// Whether a value of this parameter names a table (Parameter::table), and not a number.
inline bool isTable(const Parameter& parameter, const std::string& text) {
  return parameter.table && text.find(".csv") != text.npos;
}

/// Returns the settings completed with defaults. Throws Misuse unless every setting names a parameter and lies within
/// its range.
Settings completedSettings(std::string_view scene, const std::vector<Parameter>& parameters, const Settings& given);

/// A completed setting as a number, with all digits of its text. Throws Misuse for a parameter that the entry lacks.
template <class Real>
Real number(const Settings& settings, const std::string& name);

/// A constant of the scene with all digits of its decimal text: decimal<Real>("3.1415927").
template <class Real>
Real decimal(const char* text);

/// Constants of the scene with all digits of their decimal texts.
template <class Real, std::size_t N>
std::array<Real, N> decimals(const char* const (&texts)[N]) {
  std::array<Real, N> values;
  for (std::size_t i = 0; i < N; ++i) values[i] = decimal<Real>(texts[i]);
  return values;
}

template <class Real>
Real piOf();

/// A component of u, x or z. The time derivative of a component of u gets the same name with a prime.
struct Component {
  std::string name;
  std::string unit = {};  ///< empty: none
  double scale = 1;       ///< typical magnitude
  double rate_scale = 1;  ///< typical magnitude of the time derivative; for u only
};

/// Components with these names, all with one unit and the scale 1.
std::vector<Component> named(const std::string& unit, std::initializer_list<const char*> names);

/// y1, y2, ... (or another name with numbers), all with one unit and one scale.
std::vector<Component> numbered(Index count, const std::string& name = "y", const std::string& unit = "",
                                double scale = 1, double rate_scale = 1);

/// Sets scene.names, units and scale. If scene.time_unit is not s, set it before this call.
template <class Real>
void setComponents(Scene<Real>& scene, const std::vector<Component>& u, const std::vector<Component>& x = {},
                   const std::vector<Component>& z = {});

/// Tolerances for ReferenceCase: many digits for cheap scenes, few for thousands of elastic oscillations.
inline constexpr double kManyDigits = 1e-28, kFewDigits = 1e-19;

namespace detail {

struct Names {
  int constraints, switching, onSwitch, jump, snap, smoothed, times, onTime, jumpAtTime, completeStep, nonNegative,
      usesVelocity, start, exact, with;
};
/// A name is ambiguous in it if P has a member of this name, too.
template <class P>
struct WithNames : P, Names {};

/// Stops the compiler at functions that have a known name but another form: nothing would call them. Data may have
/// these names.
template <class Real, class P>
constexpr void requireForms() {
  using Named = WithNames<P>;
#define IRK_FORM(name, call, form)                                                                                \
  static_assert(                                                                                                  \
      requires { &Named::name; } || requires { requires std::is_member_object_pointer_v<decltype(&P::name)>; } || \
          requires(const P& p, const Point<Real>& at, Real* y, State<Real>& s, const Settings& values) { call; }, \
      form " is expected")
  IRK_FORM(constraints, p.constraints(at.t, at.u, y), "constraints(const T& t, const U& u, G&& g) const");
  IRK_FORM(switching, p.switching(at, y), "switching(const Point<T>& p, T* g) const");
  IRK_FORM(onSwitch, p.onSwitch(Index(0), at, y), "onSwitch(Index i, const Point<T>& p, T* d) const");
  IRK_FORM(jump, p.jump(Index(0), at, y, y, y), "jump(Index i, const Point<T>& p, T* u, T* v, T* x) const");
  IRK_FORM(snap, p.snap(Index(0), at, y, y, y), "snap(Index i, const Point<T>& p, T* u, T* v, T* x) const");
  IRK_FORM(smoothed, p.smoothed(at, y), "smoothed(const Point<T>& p, T* d) const");
  IRK_FORM(times, std::vector<Real>(p.times()), "std::vector<Real> times() const");
  IRK_FORM(onTime, p.onTime(Index(0), at, y), "onTime(Index i, const Point<T>& p, T* d) const");
  IRK_FORM(jumpAtTime, p.jumpAtTime(Index(0), at, y, y, y),
           "jumpAtTime(Index i, const Point<T>& p, T* u, T* v, T* x) const");
  IRK_FORM(completeStep, bool(p.completeStep(at, y, y, y, y)),
           "bool completeStep(const Point<T>& p, T* u, T* v, T* x, T* d) const");
  IRK_FORM(nonNegative, bool(p.nonNegative(Index(0))), "bool nonNegative(Index i) const");
  IRK_FORM(usesVelocity, bool(p.usesVelocity()), "bool usesVelocity() const");
  IRK_FORM(start, p.start(s), "start(State<Real>& s) const");
  IRK_FORM(exact, State<Real>(p.exact(s.t)), "State<Real> exact(const Real& t) const");
  IRK_FORM(with, P(P::with(values)), "static P with(const Settings& values)");
#undef IRK_FORM
}

/// The kinks of the tables that the scene has read so far, ascending.
template <class Real>
std::vector<Real> kinksSoFar() {
  std::vector<Real> kinks;
  for (const auto& text : kinksRead()) kinks.push_back(decimal<Real>(text.c_str()));
  std::sort(kinks.begin(), kinks.end());
  kinks.erase(std::unique(kinks.begin(), kinks.end()), kinks.end());
  return kinks;
}

}  // namespace detail

/// Sets scene.system from a problem struct, which is copied, and scene.start to zeros of its sizes: to be called before
/// the start is filled, and after its tables are made (irk/table.h). Throws Misuse for sizes that cannot be.
template <class Real, class P>
void setProblem(Scene<Real>& scene, P problem) {
  detail::requireForms<Real, P>();
  scene.start = State<Real>(makeSystem<Real>(problem)->sceneSizes());
  scene.system = [problem = std::move(problem), kinks = detail::kinksSoFar<Real>()](const SystemOptions& options) {
    return makeSystem<Real>(problem, options, kinks);
  };
}

/// Computes start.w = (a, k, z) from start.u, v, x. Throws Misuse if the start is not consistent, which is a mistake in
/// the scene, and for a scene without a system (setProblem).
template <class Real>
void completeStart(Scene<Real>& scene);

/// The same for a start that is known in part: first changes the components of u and v with these names (as
/// setComponents names them: "phi", "phi'") such that the position constraints g(t, u) = 0 and their derivatives
/// dg/dt = 0 hold; their values in start.u and start.v are first guesses. Gauss-Newton steps, the least change where
/// more components are named than needed. Throws Misuse for an unknown name, and where the constraints cannot be met.
template <class Real>
void completeStart(Scene<Real>& scene, const std::vector<std::string>& unknown);

/// What a scene says of its problem besides the equations and the start.
template <class Real>
struct SceneFrame {
  double t_end = 1;
  std::string time_unit = "s";  ///< empty: the scene has no units
  /// If all three are empty, the components are called y1, y2, ... in the order u, x, z, with the scale 1.
  std::vector<Component> u = {}, x = {}, z = {};
  std::vector<typename Scene<Real>::Output> outputs = {};
  std::vector<std::string> unknown = {};  ///< components of the start that the constraints determine: completeStart
  bool exact_holds = true;                ///< false: with these parameters `exact` is not the solution
};

/// Names the components of a frame without names, as many as `start` has. A frame that names some may leave whole lists
/// out, whose components are then u1, u2, ..., x1 or z1 and so on. Throws Misuse for a list of another length.
template <class Real>
void nameComponents(SceneFrame<Real>& frame, const State<Real>& start) {
  const Index nu = start.u.size(), nx = start.x.size(), nz = start.z().size();
  if (frame.u.empty() && frame.x.empty() && frame.z.empty()) {
    const auto all = numbered(nu + nx + nz);
    frame.u.assign(all.begin(), all.begin() + nu);
    frame.x.assign(all.begin() + nu, all.begin() + nu + nx);
    frame.z.assign(all.begin() + nu + nx, all.end());
    return;
  }
  const auto complete = [](const std::string& list, std::vector<Component>& names, Index count) {
    if (names.empty()) {
      names = numbered(count, list);
    } else if (std::ssize(names) != count) {
      throw Misuse("the frame names " + std::to_string(names.size()) + " components of " + list + ", and sizes() has " +
                   std::to_string(count));
    }
  };
  complete("u", frame.u, nu);
  complete("x", frame.x, nx);
  complete("z", frame.z, nz);
}

/// The scene of a problem P with `frame`. Its start is that of `start`, completed; without `start` the exact solution
/// at t = 0, or zeros, completed. Throws Misuse as completeStart.
template <class Real, class P>
Scene<Real> framedScene(const P& problem) {
  Scene<Real> scene;
  setProblem(scene, problem);
  SceneFrame<Real> frame = problem.frame();
  scene.t_end = frame.t_end;
  scene.time_unit = std::move(frame.time_unit);
  scene.outputs = std::move(frame.outputs);
  nameComponents(frame, scene.start);
  setComponents(scene, frame.u, frame.x, frame.z);
  constexpr bool kStarts = requires { problem.start(scene.start); };
  if constexpr (requires { problem.exact(scene.start.t); }) {
    if (frame.exact_holds) scene.exact = [problem](const Real& t) { return problem.exact(t); };
    if (!kStarts) scene.start = problem.exact(Real(0));
    if (!kStarts) return scene;
  }
  if constexpr (kStarts) problem.start(scene.start);
  if (frame.unknown.empty()) {
    completeStart(scene);
  } else {
    completeStart(scene, frame.unknown);
  }
  return scene;
}

/// The scene of the struct P with these values of its parameters.
template <class Real, class P>
Scene<Real> sceneWith(const Settings& values) {
  if constexpr (requires { P::make(values); }) {
    return P::make(values);
  } else if constexpr (requires { P::with(values); }) {
    return framedScene<Real>(P::with(values));
  } else {
    return framedScene<Real>(P{});
  }
}

namespace detail {

template <class P>
constexpr bool kHasConstraints = requires(const P& p, const Point<double>& at, double* g) {
  p.constraints(at.t, at.u, g);
};

}  // namespace detail

/// Completes the entry of a scene's struct by the makers of the scalars that this file is compiled for: double and
/// BigFloat, or with IRK_DIGITS the one that it names: 16 for double, 50 for BigFloat, of any number of digits. A
/// struct with `constraints` is of the kind kConstrained, unless its entry names another one. `static`: to gcc,
/// functions of equal templates S in the unnamed namespaces of two files are one function.
template <template <class> class S>
static SceneEntry sceneEntryOf(SceneEntry entry) {
  if (detail::kHasConstraints<S<double>> && entry.kind == SceneKind::kOde) entry.kind = SceneKind::kConstrained;
#if !defined(IRK_DIGITS) || IRK_DIGITS == 16
  entry.make = sceneWith<double, S<double>>;
#endif
#if !defined(IRK_DIGITS) || IRK_DIGITS == 50
  entry.make_big_float = sceneWith<BigFloat, S<BigFloat>>;
#endif
  return entry;
}
/// The same for a struct that has its entry itself.
template <template <class> class S>
static SceneEntry sceneEntryOf() {
  return sceneEntryOf<S>(S<double>::entry());
}

}  // namespace irk

/// Makes the struct template S a scene of the program. One per file; a file of the suite may have several, each of
/// which defines the function irk::scenes::S that problems/catalogue/catalogue.cpp lists.
#if defined(IRK_DIGITS)
#define IRK_SCENE(S) \
  extern "C" void irk_scene(::irk::SceneEntry* entry) { *entry = ::irk::sceneEntryOf<S>(); }
#elif defined(IRK_SUITE)
#define IRK_SCENE(S)                             \
  namespace irk::scenes {                        \
  SceneEntry S() { return sceneEntryOf<::S>(); } \
  }
#else
#define IRK_SCENE(S)                                                         \
  IRK_REGISTER {                                                             \
    auto entry = ::irk::sceneEntryOf<S>();                                   \
    entry.folder = ::std::filesystem::path(__FILE__).parent_path().string(); \
    ::irk::registerScene(::std::move(entry));                                \
  }
#endif
