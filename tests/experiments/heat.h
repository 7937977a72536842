// The heat equation in finite differences, a first-order system with a tridiagonal Jacobian.
#pragma once

#include <cmath>
#include <numbers>

#include "irk/problem.h"
#include "irk/scene.h"

namespace irk {

inline constexpr Index kHeatPoints = 30;

/// x_i' = (x_{i-1} - 2 x_i + x_{i+1}) / dx^2. `switched`: from t = 0.05 on, the last point also heats the first.
struct Heat {
  bool switched = false;

  Sizes sizes() const { return {.nx = kHeatPoints, .discrete = switched ? 1 : 0, .switches = switched ? 1 : 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const double scale = (kHeatPoints + 1.0) * (kHeatPoints + 1.0);
    for (Index i = 0; i < kHeatPoints; ++i) {
      const T left = i > 0 ? T(p.x[i - 1]) : T(0.0), right = i + 1 < kHeatPoints ? T(p.x[i + 1]) : T(0.0);
      r.x[i] = scale * (left - 2.0 * p.x[i] + right) - p.k[i];
    }
    if (switched) r.x[0] += T(1000.0 * p.d[0] * p.x[kHeatPoints - 1]);
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = switched && p.d[0] < T(0.5) ? T(p.t - 0.05) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T* d) const {
    d[0] = T(1.0);
  }
};

inline Scene<double> heatScene(bool switched = false) {
  Scene<double> scene;
  scene.id = "heat";
  const Heat heat{switched};
  scene.system = [heat](const SystemOptions& options) { return makeSystem<double>(heat, options); };
  scene.start = State<double>(heat.sizes());
  for (Index i = 0; i < kHeatPoints; ++i) {
    scene.start.x[i] = std::sin(std::numbers::pi * static_cast<double>(i + 1) / (kHeatPoints + 1.0));
  }
  return scene;
}

}  // namespace irk
