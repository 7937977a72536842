// Errors of a final state against exact or reference values.
#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "irk/scene.h"

namespace irk {

/// The source of the values that an error refers to.
enum class ReferenceKind {
  kNone,   ///< nothing is known at the state's time: errors are NaN
  kExact,  ///< Scene::exact
  kFile,   ///< values of problems/reference
};
/// `none`, `exact`, `file`.
std::string_view referenceName(ReferenceKind kind);

/// The largest relative error |y - ref| / max(|ref|, scale) per group of components, and over all components and
/// outputs with a reference. NaN without a reference.
struct RunErrors {
  double all = std::numeric_limits<double>::quiet_NaN();
  double u = all, v = all, x = all, z = all;
  /// Largest |g| over the position constraints g(t, u) = 0 of the scene. NaN without constraints.
  double drift = all;
  ReferenceKind reference = ReferenceKind::kNone;
};

/// All components u, v, x, z of a state, one after the other.
template <class Real>
Vec<Real> components(const State<Real>& s);

/// Compares with Scene::exact if it knows any component at the state's time, else with the references at that time.
/// The references must belong to the scene's settings.
template <class Real>
RunErrors errorsOf(const Scene<Real>& scene, const std::vector<Reference>& references, const State<Real>& state);

}  // namespace irk
