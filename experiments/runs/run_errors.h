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
/// outputs with a reference. NaN without a reference.
struct RunErrors {
  double all = std::numeric_limits<double>::quiet_NaN();
  double u = all, v = all, x = all, z = all;
  /// Largest |g| over the position constraints g(t, u) = 0 of the scene. NaN without constraints.
  double drift = all;
  ReferenceKind reference = ReferenceKind::kNone;
  /// The accuracy of a computed reference, measured as `all` is. NaN for the other kinds.
  double accuracy = std::numeric_limits<double>::quiet_NaN();
  /// Why `all` is NaN although a reference was asked for, in one line; else empty.
  std::string remark = {};
};

/// The larger errors of two times. Errors are unknown if there is no reference at one of the times; an error that is
/// not measurable at one time is that at the other.
RunErrors largerErrors(const RunErrors& a, const RunErrors& b);

/// An error below this many accuracies of a computed reference is not measurable.
inline constexpr double kMeasurable = 10;

/// All components u, v, x, z of a state, one after the other.
template <class Real>
Vec<Real> components(const State<Real>& s);

/// Compares with Scene::exact if it knows any component at the state's time, else with the references at that time.
/// The references must belong to the scene's settings.
template <class Real>
RunErrors errorsOf(const Scene<Real>& scene, const std::vector<Reference>& references, const State<Real>& state);

/// Compares with computed values at the state's time only. Errors that are not measurable are NaN; `accuracy` and, if
/// `all` is such an error, `remark` are set.
template <class Real>
RunErrors errorsByComputed(const Scene<Real>& scene, const std::vector<Reference>& computed, const State<Real>& state);

}  // namespace irk
