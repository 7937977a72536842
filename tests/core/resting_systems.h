// Systems that begin next to an unstable rest.
#pragma once

#include <cmath>

#include "tests/core/problems.h"

namespace irk::test {

/// A spiral around (1, 1) from (1 + 1e-6, 1): its radius is 1e-6 e^(growth t).
struct Spiral {
  double growth, frequency;
  Sizes sizes() const { return {.nx = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T x = p.x[0] - 1.0, y = p.x[1] - 1.0;
    r.x[0] = growth * x - frequency * y - p.k[0];
    r.x[1] = frequency * x + growth * y - p.k[1];
  }
  State<double> start() const { return startOf(sizes(), {.x = {1 + 1e-6, 1}}); }
};

/// An oscillator of frequency 1 beside x' = L sin(x - 1), which leaves 1 for 1 + pi.
struct RestBesideMotion {
  double L;
  Sizes sizes() const { return {.nu = 1, .nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.u[0] - p.a[0];
    using std::sin;
    r.x[0] = L * sin(p.x[0] - 1.0) - p.k[0];
  }
  State<double> start() const { return startOf(sizes(), {.u = {1}, .x = {1 + 1e-9}}); }
};

}  // namespace irk::test
