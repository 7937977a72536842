// The exact solution of the nonlinear DAEs x' = f(x, z), 0 = g(x, z): all components are exponentials of t. Internal.
#pragma once

#include <array>

#include "irk/scene_file.h"

namespace irk {

/// The state at t of the solution x_i = exp(rates_i t), and z = exp(rates_N t) with the last of the N + 1 rates.
template <class Real, std::size_t N>
State<Real> exponentials(const Sizes& sizes, const Real& t, const std::array<int, N>& rates) {
  using std::exp;
  State<Real> s(sizes);
  s.t = t;
  for (Index i = 0; i < s.x.size(); ++i) {
    const int rate = rates[static_cast<std::size_t>(i)];
    s.x[i] = exp(rate * t);
    s.w[i] = rate * s.x[i];
  }
  s.w[s.x.size()] = exp(rates.back() * t);
  return s;
}

}  // namespace irk
