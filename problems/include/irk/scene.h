// A scene: a problem with its parameters, start, end, names, units, magnitudes, diagrams and checked values.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "irk/multiprecision.h"
#include "irk/problem.h"

namespace irk {

/// `--set name=value`: text, checked against the scene's parameter list.
using Settings = std::map<std::string, std::string>;

/// One parameter of a scene: a number with unit and range, or a choice among words.
struct Parameter {
  std::string name;
  std::string unit;
  std::string meaning;
  std::string default_value;
  double min = 0, max = 0;           ///< numbers: allowed range
  std::vector<std::string> choices;  ///< words: allowed values; empty for numbers
  bool changes_solution = true;      ///< false: another description of the same physics
  bool whole = false;                ///< numbers: integers only
  double audit_max = 0;              ///< > 0: the audit draws whole numbers up to here
  bool is_time = false;              ///< a time of the run: the audit draws it between its start and its end
  bool only_smooth = false;          ///< of effect only where switches are made smooth
};

/// A scene over one scalar, its parameters fixed. Value type; its systems are immutable.
template <class Real>
struct Scene {
  std::string id;
  std::function<std::shared_ptr<const System<Real>>(const SystemOptions&)> system;
  State<Real> start;  ///< t0, u, v, x consistent; w = (a, k, z) at least a good guess
  double t_end = 1;
  std::string time_unit = "s";     ///< empty: the scene has no units
  std::vector<std::string> names;  ///< u, v, x, z in order: "theta", "theta'", "p0", "lambda"
  std::vector<std::string> units;  ///< same order: "rad", "rad/s", "Pa", "N"; empty: none
  Vec<double> scale;               ///< typical magnitude per component, same order: weights of atol
  /// Exact state at t (u, v, x, z; NaN where unknown); empty when no closed form is known.
  std::function<State<Real>(const Real& t)> exact;
  /// Derived quantities by name ("x3", "energy"), for tables, references and plots.
  struct Output {
    std::string name;
    std::function<Real(const State<Real>&)> value;
    std::string unit = {};
  };
  std::vector<Output> outputs;

  Sizes sizes() const { return system({})->sizes(); }
};

/// What theory can say about the order of convergence on a scene.
enum class SceneKind {
  kOde,                ///< differential equations without stiffness or with one that theory does not cover
  kStiffTest,          ///< y' = lambda (y - phi) + phi': orders are known without stiffness and in its limit
  kSingularlyPerturbed,  ///< orders are known without stiffness only
  kIndex1,             ///< x' = f(x, z), 0 = g(x, z)
  kIndex2,             ///< x' = f(x, z), 0 = g(x)
  kIndex3,             ///< y' = f(y, w), w' = k(y, w, z), 0 = g(y); x is (y, w)
  kConstrained,        ///< M u'' = f - G^T z, 0 = g(u): orders depend on the formulation
};
/// For lists: `index 2: x' = f(x, z), 0 = g(x)`.
std::string_view meaningOf(SceneKind kind);

/// The parameter by which a scene becomes stiff.
struct Stiffness {
  std::string parameter;     ///< empty: there is none
  bool reciprocal = false;   ///< the stiffness is 1 / parameter
};

/// The parameter by which a scene gets as many unknowns as one likes.
struct SizeParameter {
  std::string parameter;  ///< empty: there is none
  int unknowns = 1;       ///< for each unit of it
  double step = 0;        ///< s: about what an accurate run takes
};

/// A diagram over time.
struct Panel {
  std::string title;                 ///< "pressures"
  std::vector<std::string> columns;  ///< names of components and outputs; "a:b" is b over a at equal scales
  std::string unit = {};             ///< empty: that of the columns
  double factor = 1;                 ///< what turns their unit into this one
};

/// Parameters with which `irk reference` computes checked values, in 50 digits.
struct ReferenceCase {
  std::string settings = {};  ///< `name=value name=value`, besides the defaults
  std::string times = {};     ///< decimal, ascending, separated by blanks; the scene's end is added
  double tolerance = 1e-26;   ///< > 0, of the coarser runs
  /// > 0: fixed steps of this size and of half of it with full Newton, where simplified Newton diverges.
  double step = 0;
};

/// One line of the catalogue: what a scene is, for every program and figure that uses it.
struct SceneEntry {
  std::string id;
  std::string title;  ///< one line: what it is
  std::string shows;  ///< one line: what it is there to show
  SceneKind kind = SceneKind::kOde;  ///< of its default form
  Stiffness stiffness = {};
  SizeParameter size = {};
  std::vector<Parameter> parameters;
  std::vector<Panel> panels = {};  ///< empty: one per component
  std::vector<ReferenceCase> reference_cases = {};  ///< the defaults among them
  std::function<Scene<double>(const Settings&)> make;
  std::function<Scene<mp50>(const Settings&)> make_mp50;
  /// Empty unless orders from 20 on are measured with the scene.
  std::function<Scene<mp100>(const Settings&)> make_mp100 = {};
};

/// All scenes, sorted by id. Ids are stable for ever.
const std::vector<SceneEntry>& sceneCatalogue();

/// Throws Misuse naming the nearest known id.
const SceneEntry& findScene(std::string_view id);

/// Checks settings against the entry's parameters (unknown name -> nearest known; out of range ->
/// name, value, range), completes them with defaults, and builds. Throws Misuse, also for a scalar
/// that the scene does not offer.
template <class Real>
Scene<Real> makeScene(std::string_view id, const Settings& settings = {});
/// The same of an entry that need not be in the catalogue.
template <class Real>
Scene<Real> makeScene(const SceneEntry& entry, const Settings& settings);

/// A checked value of problems/reference/*.csv.
struct Reference {
  double t = 0;
  std::string component;  ///< a component name or an output name
  std::string value;      ///< all digits, as text
  double accuracy = 0;    ///< stated absolute accuracy of the value
  std::string source;
};

/// The references of a scene with these settings (those that change the solution must match; a
/// parameter at its default need not be given). Sorted by t; where the files hold several values of
/// one component, only the most accurate.
std::vector<Reference> references(std::string_view id, const Settings& settings = {});

}  // namespace irk
