// A run as a value: everything that determines its numbers, as a struct, as text and as a key.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/options/axis.h"
#include "irk/options.h"
#include "irk/scene.h"

namespace irk {

/// The numbers that a run computes in: `double`, or `mpN` with N decimal digits (irk/multiprecision.h).
struct ScalarKind {
  static constexpr int kLeastDigits = 30, kMostDigits = 1000;
  int digits = 0;  ///< 0: double; else kLeastDigits .. kMostDigits

  bool isDouble() const { return digits == 0; }
  bool operator==(const ScalarKind&) const = default;
};
std::string idOf(ScalarKind scalar);
IRK_DECLARE_AXIS(ScalarKind);

/// Which position constraints are integrated.
enum class ConstraintUse {
  kAll,
  kIndependent,  ///< those that a rank-revealing factorization chooses at the start; see irk/dependent_constraints.h
};
IRK_DECLARE_AXIS(ConstraintUse);

/// How an error is measured if neither a closed form nor problems/reference gives the solution at t_end.
enum class ReferenceUse {
  kNone,  ///< not at all: the error is unknown
  kAuto,  ///< with a reference that is computed and kept (experiments/reference)
};
IRK_DECLARE_AXIS(ReferenceUse);

/// Whether the error of a success is measured by a second, independent integration (irk/error_bar.h).
enum class ErrorBarUse {
  kNone,      ///< it is not
  kMeasured,  ///< the result keeps its values and gets an error bar
  kRefined,   ///< the result takes the values of the strictest integration, if that is stricter than the run
};
IRK_DECLARE_AXIS(ErrorBarUse);

inline constexpr int kMaxReferenceTimes = 1000;

/// The unit round-off of this kind of number; 1e-300 for more digits than a double can tell apart from 0.
double epsilonOf(ScalarKind scalar);

/// The settings of a run. fields.cpp has their legal values and meanings; a new member needs a line there.
struct RunSpec {
  std::string scene;
  /// An id of `configurations`; tables and figures show it.
  std::string configuration = "default";
  Settings settings;
  /// The id of a method (a peer's too) or a tableau file; with variable order also the id of a family.
  std::string method = "radau_iia_5";
  Formulation formulation = Formulation::kIndex2;
  ConstraintScaling scaling = ConstraintScaling::kOn;
  ConstraintUse constraints = ConstraintUse::kAll;
  Discontinuity discontinuity = Discontinuity::kLocate;
  ScalarKind scalar;
  IntegratorOptions options;
  /// Absolute tolerances of single components by their names, > 0, instead of atol times their scale.
  Settings atol_of = {};
  /// 1 .. kMaxStages. With variable order, the stages of the family's largest member.
  int max_stages = 13;
  /// NaN stands for the scene's own end time.
  double t_end = std::numeric_limits<double>::quiet_NaN();
  /// >= 0, in seconds of the thread's CPU clock; 0 = no limit.
  double time_limit = 0;
  /// Changes only the errors of a run. It is part of the key, so that a run without an error is made again when a study
  /// asks for errors.
  ReferenceUse reference = ReferenceUse::kNone;
  /// n >= 1: errors are also taken at k / n of t_end, k = 1 .. n, by a run to each of these times.
  int reference_times = 1;
  ErrorBarUse error_bar = ErrorBarUse::kNone;
};

/// Fills in the scene's t_end and removes settings that equal their defaults, so that equal runs have equal specs.
/// Throws Misuse for an unknown scene or setting, and for reference times of a run whose end is not known.
RunSpec resolved(RunSpec spec);

/// Replaces every value `X/h` of the settings by X / h, for stiffness that grows as the step shrinks: `lambda=-1e8/h`
/// gives z = h lambda = -1e8. Without a known step, h = 1.
Settings settingsAtStep(const RunSpec& spec);

/// Everything that determines a run except the code: the canonical text of the resolved spec, the scene's parameters
/// at their defaults, and a hash of the method's A, b and c, or of a method file's contents.
std::string keyText(const RunSpec& resolved, const std::vector<Parameter>& parameters);

/// A hash of keyText as 16 hexadecimal digits. Rows store the code's fingerprint in their own column `code`.
std::string specKey(const RunSpec& spec);

/// The integrator's name for users: a peer's id; `variable` or another configuration with variable order; else
/// `configuration:method`.
std::string integratorName(const RunSpec& spec);

/// The number of stages at the end of a method's id; 0 for a file.
Index stagesInId(std::string_view method);

/// Throws Misuse for a family with order 'fixed', which needs one method.
void refuseFamilyOfFixedOrder(const RunSpec& spec);

/// The text `name=value name=value`.
std::string settingsText(const Settings& settings);
/// Throws Misuse if `value` contains a forbidden character, which would make the text of a run ambiguous.
void requirePlain(std::string_view field, std::string_view value, std::string_view forbidden);
/// Adds `name=value`. Throws Misuse for text without a name or '='.
void addSetting(Settings& settings, std::string_view text);

}  // namespace irk
