// A scene: a problem with its parameters, start, end, names, magnitudes and checked values.
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
};

/// A scene over one scalar, its parameters fixed. Value type; its systems are immutable.
template <class Real>
struct Scene {
  std::string id;
  std::function<std::shared_ptr<const System<Real>>(const SystemOptions&)> system;
  State<Real> start;  ///< t0, u, v, x consistent; w = (a, k, z) at least a good guess
  double t_end = 1;
  std::vector<std::string> names;  ///< u, v, x, z in order: "theta", "theta'", "p0", "lambda"
  Vec<double> scale;               ///< typical magnitude per component, same order: weights of atol
  /// Exact state at t (u, v, x, z; NaN where unknown); empty when no closed form is known.
  std::function<State<Real>(const Real& t)> exact;
  /// Derived quantities by name ("x3", "energy"), for tables, references and plots.
  struct Output {
    std::string name;
    std::function<Real(const State<Real>&)> value;
  };
  std::vector<Output> outputs;

  Sizes sizes() const { return system({})->sizes(); }
};

/// One line of the catalogue.
struct SceneEntry {
  std::string id;
  std::string title;  ///< one line: what it is
  std::string shows;  ///< one line: what it is there to show
  std::vector<Parameter> parameters;
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
