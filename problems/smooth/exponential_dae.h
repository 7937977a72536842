// The common part of the nonlinear DAEs x' = f(x, z), 0 = g(x, z) with the exact solution x_i = exp(lambda_i t),
// z = exp(mu t). Each problem adds its equations. Internal.
#pragma once

#include <cmath>
#include <string>

#include "irk/scene_file.h"

namespace irk {

/// Makes the scene of a problem P. Besides `sizes` and `residual` P needs: int kAlgebraicIndex; an array of int
/// kRates (lambda) and an array of names kNames, with one entry per x; int kAlgebraicRate (mu); the name
/// kAlgebraicName; a function referenceCase.
template <class P>
struct ExponentialDae {
  static std::string id() { return "index" + std::to_string(P::kAlgebraicIndex) + "_nonlinear"; }

  static SceneKind kind() {
    return P::kAlgebraicIndex == 1   ? SceneKind::kIndex1
           : P::kAlgebraicIndex == 2 ? SceneKind::kIndex2
                                     : SceneKind::kIndex3;
  }

  template <class Real>
  static State<Real> exact(const Real& t) {
    using std::exp;
    State<Real> s(P{}.sizes());
    s.t = t;
    for (Index i = 0; i < s.x.size(); ++i) {
      const int rate = P::kRates[static_cast<std::size_t>(i)];
      s.x[i] = exp(rate * t);
      s.w[i] = rate * s.x[i];
    }
    s.w[s.x.size()] = exp(P::kAlgebraicRate * t);
    return s;
  }

  template <class Real>
  static Scene<Real> make(const Settings&) {
    Scene<Real> scene;
    setProblem(scene, P{});
    scene.t_end = 1;
    scene.time_unit = "";
    std::vector<Component> x;
    for (const char* name : P::kNames) x.push_back({name});
    setComponents(scene, {}, x, {{P::kAlgebraicName}});
    scene.exact = exact<Real>;
    scene.start = scene.exact(Real(0));
    return scene;
  }

  static SceneEntry entry() {
    const std::string index = std::to_string(P::kAlgebraicIndex);
    return {.id = id(),
            .title = "nonlinear DAE of index " + index + ", exactly solvable",
            .shows = "orders of differential and algebraic unknowns, index " + index,
            .collections = {"probes"},
            .kind = kind(),
            .reference_cases = {P::referenceCase()},
            .make = make<double>,
            .make_mp50 = make<mp50>};
  }
};

}  // namespace irk
