// Frame of the nonlinear DAEs x' = f(x, z), 0 = g(x, z) whose exact solution is x_i = exp(lambda_i
// t), z = exp(mu t): all but their equations. Internal.
#pragma once

#include <cmath>
#include <string>

#include "problems/support/build.h"

namespace irk {

/// What a problem P has to have besides sizes and residual: int kAlgebraicIndex, arrays of int
/// kRates (lambda) and of names kNames, one per x, int kAlgebraicRate (mu), the name
/// kAlgebraicName.
template <class P>
struct ExponentialDae {
  static std::string id() { return "index" + std::to_string(P::kAlgebraicIndex) + "_nonlinear"; }

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
    scene.id = id();
    setProblem(scene, P{});
    scene.t_end = 1;
    scene.names = componentNames({}, {P::kNames.begin(), P::kNames.end()}, {P::kAlgebraicName});
    scene.scale = Vec<double>::Ones(P{}.sizes().components());
    scene.exact = exact<Real>;
    scene.start = scene.exact(Real(0));
    return scene;
  }

  static SceneEntry entry() {
    const std::string index = std::to_string(P::kAlgebraicIndex);
    return {.id = id(),
            .title = "nonlinear DAE of index " + index + ", exactly solvable",
            .shows = "orders of differential and algebraic unknowns, index " + index,
            .parameters = {},
            .make = make<double>,
            .make_mp50 = make<mp50>};
  }
};

}  // namespace irk
