// A run is a value: everything that decides its numbers, as a struct, as text and as a key.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "irk/options.h"
#include "irk/scene.h"

namespace irk {

enum class ScalarKind { kDouble, kMp50, kMp100 };
template <>
std::span<const Named<ScalarKind>> named<ScalarKind>();
template <>
ScalarKind parseId<ScalarKind>(std::string_view id);
template <>
std::string_view axisName<ScalarKind>();

/// Round-off of a number of this kind.
double epsilonOf(ScalarKind scalar);

/// Legal values and meanings: fields.cpp. A member that is added here needs its line there.
struct RunSpec {
  std::string scene;
  /// Of `configurations`: a name for tables and figures.
  std::string configuration = "default";
  Settings settings;
  /// An id, of a peer also, or a tableau file; for variable order also a family.
  std::string method = "radau_iia_5";
  Formulation formulation = Formulation::kIndex2;
  ConstraintScaling scaling = ConstraintScaling::kOn;
  Discontinuity discontinuity = Discontinuity::kLocate;
  ScalarKind scalar = ScalarKind::kDouble;
  IntegratorOptions options;
  /// Variable order: the largest member of the method's family.
  int max_stages = 13;
  /// NaN: the scene's own.
  double t_end = std::numeric_limits<double>::quiet_NaN();
  /// Seconds of the thread's CPU clock; 0 = no limit.
  double time_limit = 0;
};

/// The scene's t_end filled in, settings at their defaults left out, so that equal runs are equal
/// specs. Throws Misuse for an unknown scene or setting.
RunSpec resolved(RunSpec spec);

/// The settings with every value `X/h` replaced by X / h: stiffness that grows as the step shrinks,
/// `lambda=-1e8/h` for z = h lambda = -1e8. Where no step is known, h = 1.
Settings settingsAtStep(const RunSpec& spec);

/// All that decides a run but code: the canonical text of the resolved spec, the scene's parameters at their defaults, a
/// hash of the method's A, b and c, or of a method file's contents.
std::string keyText(const RunSpec& resolved, const std::vector<Parameter>& parameters);

/// 16 hexadecimal digits: a hash of keyText. What the code is stands beside it in a row (`code`).
std::string specKey(const RunSpec& spec);

/// What a user would call the integrator: a peer's id, `variable` or another configuration with variable
/// order, else `configuration:method`.
std::string integratorName(const RunSpec& spec);

/// The number of stages that a method's id ends with; 0 for a file.
Index stagesInId(std::string_view method);

/// Throws Misuse for a family where one method is needed: order 'fixed'.
void refuseFamilyOfFixedOrder(const RunSpec& spec);

/// `name=value name=value`.
std::string settingsText(const Settings& settings);
/// Throws Misuse for text with one of the characters that would break a run's text apart.
void requirePlain(std::string_view field, std::string_view value, std::string_view forbidden);
/// `name=value`. Throws Misuse for text without name or '='.
void addSetting(Settings& settings, std::string_view text);

}  // namespace irk
