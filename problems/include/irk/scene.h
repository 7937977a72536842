// A scene: a problem with its parameters, start, end, names, units, magnitudes, diagrams and reference values.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "irk/multiprecision.h"
#include "irk/problem.h"
#include "irk/table.h"

namespace irk {

/// Values of parameters by name, as text (`--set name=value`). makeScene checks them against the scene's parameters.
using Settings = std::map<std::string, std::string>;

/// One parameter of a scene: a number with unit and range, or one of several words.
struct Parameter {
  std::string name;
  std::string unit;
  std::string meaning;
  std::string default_value;
  double min = 0, max = 0;           ///< for numbers: allowed range, both ends included
  std::vector<std::string> choices;  ///< for words: allowed values; empty for numbers
  bool changes_solution = true;      ///< false: another description of the same physics, with the same solution
  bool whole = false;                ///< for numbers: integers only
  double audit_max = 0;              ///< > 0: the audit draws whole numbers up to this value
  bool is_time = false;              ///< a time during the run: the audit draws it between start and end
  bool only_smooth = false;          ///< has an effect only with discontinuity `smooth`
  bool text = false;                 ///< any text; neither a number nor one of several words
  bool table = false;                ///< for numbers: a table over time is allowed, `file.csv` or `file.csv:column`
};

/// A scene over one scalar, with fixed parameters. A value type: copies are independent and own all that they need.
template <class Real>
struct Scene {
  std::string id;
  /// Makes the system of this scene; see makeSystem in irk/problem.h for its errors and for sharing by threads.
  std::function<std::shared_ptr<const System<Real>>(const SystemOptions&)> system;
  State<Real> start;  ///< t0; u, v, x are consistent; w = (a, k, z) is at least a good guess
  double t_end = 1;
  std::string time_unit = "s";     ///< empty: the scene has no units
  std::vector<std::string> names;  ///< of u, v, x, z in this order: "theta", "theta'", "p0", "lambda"
  std::vector<std::string> units;  ///< in the same order: "rad", "rad/s", "Pa", "N"; empty: none
  Vec<double> scale;               ///< typical magnitudes > 0 in the same order; they multiply atol
  /// The exact state at t (u, v, x, z; NaN if unknown). An empty function: no closed form is known.
  std::function<State<Real>(const Real& t)> exact;
  /// A quantity derived from the state ("x3", "energy"), for tables, references and plots.
  struct Output {
    std::string name;
    std::function<Real(const State<Real>&)> value;
    std::string unit = {};
    bool invariant = false;  ///< constant on the exact solution: `irk solve` prints its largest change
  };
  std::vector<Output> outputs;
  std::vector<TableRead> tables;  ///< what it has read; makeScene sets it

  Sizes sizes() const { return system({})->sizes(); }
};

/// The kind of a scene's equations. Theory predicts the order of convergence for each kind.
enum class SceneKind {
  kOde,                  ///< ordinary differential equations; no theory of their stiffness, if any, is used
  kStiffTest,            ///< y' = lambda (y - phi) + phi': orders are known for no stiffness and for its limit
  kSingularlyPerturbed,  ///< orders are known without stiffness only
  kIndex1,               ///< x' = f(x, z), 0 = g(x, z)
  kIndex2,               ///< x' = f(x, z), 0 = g(x)
  kIndex3,               ///< y' = f(y, w), w' = k(y, w, z), 0 = g(y); x is (y, w)
  kConstrained,          ///< M u'' = f - G^T z, 0 = g(u): orders depend on the formulation
};
/// The index of the equations of a kind as they are written: 0 for ordinary differential equations, 3 for position
/// constraints.
int indexOf(SceneKind kind);
/// The meaning of a kind in one line, for lists: `index 2: x' = f(x, z), 0 = g(x)`.
std::string_view meaningOf(SceneKind kind);

/// The parameter that controls the stiffness of a scene.
struct Stiffness {
  std::string parameter;    ///< its name; empty: there is none
  bool reciprocal = false;  ///< true: the stiffness is 1 / parameter
};

/// The parameter that controls the number of unknowns of a scene.
struct SizeParameter {
  std::string parameter;  ///< its name; empty: there is none
  int unknowns = 1;       ///< number of unknowns per unit of the parameter
  double step = 0;        ///< in the scene's time unit: typical step size of an accurate run
};

/// A diagram of components and outputs over time.
struct Panel {
  std::string title;                 ///< "pressures"
  std::vector<std::string> columns;  ///< names of components and outputs; "a:b" plots b over a at equal scales
  std::string unit = {};             ///< of the plotted values; empty: that of the columns
  double factor = 1;                 ///< converts the unit of the columns into `unit`
};

/// A case for which `irk reference` computes reference values in 50 digits.
struct ReferenceCase {
  std::string settings = {};  ///< `name=value name=value`; other parameters have their defaults
  std::string times = {};     ///< decimal, ascending, separated by blanks; the scene's end is added
  double tolerance = 1e-26;   ///< > 0; tolerance of the coarser runs
  /// > 0: uses fixed steps of this size and of half of it, with full Newton; for cases where simplified Newton
  /// diverges.
  double step = 0;
};

/// The description of a scene in the catalogue. Programs and figures take all that they know of a scene from it.
struct SceneEntry {
  std::string id;
  std::string title;  ///< one line: what the scene is
  std::string shows;  ///< one line: what the scene demonstrates
  /// The collections that the scene is in (irk/collections.h): small letters, digits and '_'.
  std::vector<std::string> collections = {};
  std::string literature = {};       ///< one line: where the problem is described; empty: made for this suite
  SceneKind kind = SceneKind::kOde;  ///< with the default parameters
  Stiffness stiffness = {};
  SizeParameter size = {};
  std::vector<Parameter> parameters = {};
  std::vector<Panel> panels = {};                   ///< empty: one panel per component
  std::vector<ReferenceCase> reference_cases = {};  ///< including the case of the default parameters
  /// Build the scene from complete, checked settings; users call makeScene. An empty function: the scene does not
  /// offer this scalar.
  std::function<Scene<double>(const Settings&)> make = {};
  std::function<Scene<BigFloat>(const Settings&)> make_big_float = {};
  /// Set by registerScene: that it is not one of the library's, and the file that it comes from, if the program loaded
  /// it.
  bool registered = false;
  std::string source = {};
  std::string folder = {};  ///< of the files that its tables name; empty: the working folder
};

/// All scenes: those of the library sorted by id, then those that were registered. Ids never change.
const std::deque<SceneEntry>& sceneCatalogue();

/// Adds a scene; from then on it is one like all others. Throws Misuse for an id that is taken, naming both sources,
/// and for an id or a collection that is not made of small letters, digits and '_'. Not while other threads use the
/// catalogue.
void registerScene(SceneEntry entry);

/// The entry of a scene; it lives as long as the program. Throws Misuse for an unknown id, naming the nearest one.
const SceneEntry& findScene(std::string_view id);

/// Checks the settings against the scene's parameters, adds the defaults and builds the scene. Throws Misuse for an
/// unknown id or parameter (naming the nearest one), for a value out of range (naming the range), for a scalar that the
/// scene does not offer, and for a scene whose system, start, end, scale, names, units, exact solution or outputs do
/// not fit each other.
template <class Real>
Scene<Real> makeScene(std::string_view id, const Settings& settings = {});
/// The same for an entry that need not be in the catalogue.
template <class Real>
Scene<Real> makeScene(const SceneEntry& entry, const Settings& settings);

/// Throws Misuse if a table of the scene does not have all times from its start to t_end.
template <class Real>
void requireInTables(const Scene<Real>& scene, double t_end);

/// A reference value of problems/reference/*.csv.
struct Reference {
  double t = 0;
  std::string component;  ///< a component name or an output name
  std::string value;      ///< all digits, as text
  double accuracy = 0;    ///< absolute accuracy that the source states
  std::string source;     ///< where the value comes from
};

/// The reference values of a scene with these settings, sorted by t. Parameters that change the solution must match;
/// a parameter at its default need not be given. If the files hold several values of one component at one time, only
/// the most accurate is returned. Throws Misuse as makeScene for an unknown id and for bad settings.
std::vector<Reference> references(std::string_view id, const Settings& settings = {});

}  // namespace irk
