// Owns the numbers of a Point in a scalar T, and the residual at this point.
#pragma once

#include "core/derivatives/pattern.h"

namespace irk {

template <class T>
struct PointBuffers {
  Sizes sizes;
  Vec<T> u, v, x, w, d, r;

  explicit PointBuffers(const Sizes& n) : sizes(n), u(n.nu), v(n.nu), x(n.nx), w(n.n()), d(n.discrete), r(n.n()) {}

  template <class Real>
  void copy(const Point<Real>& p) {
    const Index nu = sizes.nu, nx = sizes.nx;
    for (Index i = 0; i < nu; ++i) u[i] = p.u[i];
    for (Index i = 0; i < nu; ++i) v[i] = p.v[i];
    for (Index i = 0; i < nx; ++i) x[i] = p.x[i];
    for (Index i = 0; i < nu; ++i) w[i] = p.a[i];
    for (Index i = 0; i < nx; ++i) w[nu + i] = p.k[i];
    for (Index i = 0; i < sizes.nz; ++i) w[nu + nx + i] = p.z[i];
    for (Index i = 0; i < sizes.discrete; ++i) d[i] = p.d[i];
  }
  Point<T> at(const T& t) const {
    const Index nu = sizes.nu, nx = sizes.nx;
    return {t,
            {u.data(), nu},
            {v.data(), nu},
            {x.data(), nx},
            {w.data(), nu},
            {w.data() + nu, nx},
            {w.data() + nu + nx, sizes.nz},
            {d.data(), sizes.discrete}};
  }
  VecView<T> residual() { return {r.data(), r.size()}; }
  /// The component along which a direction differentiates.
  T& component(const Direction& along) {
    if (along.matrix == 0) return w[along.column];
    if (along.matrix == 2) return u[along.column];
    return along.column < sizes.nu ? v[along.column] : x[along.column - sizes.nu];
  }
};

}  // namespace irk
