// Errors of a final state against exact or reference values.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "irk/scene.h"

namespace irk {

/// The source of the values that an error refers to.
enum class ReferenceKind {
  kNone,      ///< nothing is known at the state's time: errors are NaN
  kExact,     ///< Scene::exact
  kFile,      ///< values of problems/reference
  kComputed,  ///< values computed for this run (experiments/reference)
};
/// `none`, `exact`, `file`, `computed`.
std::string_view referenceName(ReferenceKind kind);

/// The largest relative error |y - ref| / max(|ref|, scale) per group of components, and over all components and
/// outputs with a reference. NaN without a reference. `mixed` and `relative` are the errors by which the IVP test set
/// counts digits.
struct RunErrors {
  double all = std::numeric_limits<double>::quiet_NaN();
  double u = all, v = all, x = all, z = all;
  double mixed = all;     ///< the largest |y - ref| / (atol / rtol + |ref|); NaN also if atol / rtol is not known
  double relative = all;  ///< the largest |y - ref| / |ref| of those with ref != 0
  double t = all;         ///< |t - ref| of a run that ends at a switch (stop_at); else NaN
  /// Largest |g| over the position constraints g(t, u) = 0 of the scene. NaN without constraints.
  double drift = all;
  ReferenceKind reference = ReferenceKind::kNone;
  /// The accuracy of a computed reference, measured as `all` is. NaN for the other kinds.
  double accuracy = std::numeric_limits<double>::quiet_NaN();
  /// Why `all` is NaN although the run asks for a reference, in one line; otherwise empty.
  std::string remark = {};

  /// The digits of `mixed` and of `relative` as the IVP test set counts them: -log10; infinite for an error of 0.
  double mescd() const;
  double scd() const;
};

/// The ratio of the absolute to the relative tolerance.
struct ToleranceRatio {
  double atol_over_rtol = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not known, or without meaning
  Vec<double> scale = {};  ///< of u, v, x, z: the magnitudes that atol is multiplied by; empty: 1, as for outputs
};

/// How a computed reference calls the time of the switch at which its runs end. No component has this name.
inline constexpr std::string_view kEventTime = "time of the event";

/// The larger errors of two times. Errors are unknown if one of the times has no reference. An error that is not
/// measurable at one time takes its value at the other.
RunErrors largerErrors(const RunErrors& a, const RunErrors& b);

/// An error is not measurable below this many accuracies of a computed reference.
inline constexpr double kMeasurable = 10;

/// All components u, v, x, z of a state, one after the other.
template <class Real>
Vec<Real> components(const State<Real>& s);

/// Compares with Scene::exact if it knows any component at the state's time, else with the references at that time.
/// The references must belong to the scene's settings.
template <class Real>
RunErrors errorsOf(const Scene<Real>& scene, const std::vector<Reference>& references, const State<Real>& state,
                   const ToleranceRatio& ratio = {});

/// Compares with computed values at the state's time only. Errors that are not measurable are NaN; `accuracy` and, if
/// `all` is such an error, `remark` are set.
template <class Real>
RunErrors errorsByComputed(const Scene<Real>& scene, const std::vector<Reference>& computed, const State<Real>& state,
                           const ToleranceRatio& ratio = {});

}  // namespace irk
