// From a user's struct to a System: the formulation of its position constraints, and its switches.
//
// A problem is one struct of about 30 lines:
//
//   struct Pendulum {
//     double m = 1, l = 1, g = 9.81;
//     Sizes sizes() const { return {.nu = 2, .nx = 0, .nz = 1, .constraints = 1}; }
//     template <class T>
//     void residual(const Point<T>& p, Rows<T> r) const {      // F2 - M a - G^T lambda
//       r.u[0] = -m * p.a[0] - p.u[0] * p.z[0];
//       r.u[1] = -m * p.a[1] - m * g - p.u[1] * p.z[0];
//     }
//     template <class T, class U, class G>
//     void constraints(const T& t, const U& u, G&& g) const {   // g(t, u), index 3
//       g[0] = (u[0] * u[0] + u[1] * u[1] - l * l) * 0.5;
//     }
//   };
//
// Write `using std::sin;` and unqualified calls; T is double, a dual number or a multiprecision
// number. Branches may compare values of T.
//
// A problem that switches keeps its modes in the discrete state p.d (sizes().discrete numbers) and
// declares sizes().switches switching functions. Its residual never asks where it is, only p.d:
//
//     template <class T>  // p.d is valid while all g <= 0
//     void switching(const Point<T>& p, T* g) const;
//     template <class T>  // g[i] > 0: changes d, a copy of p.d
//     void onSwitch(Index i, const Point<T>& p, T* d) const;
//
// and, where they exist:
//
//     template <class T>  // what jumps; p.d is the new one. Only where switches are located.
//     void jump(Index i, const Point<T>& p, T* u, T* v, T* x) const;
//     template <class T>  // what is known exactly in the new mode, where u, v, x are continuous: a
//     void snap(Index i, const Point<T>& p, T* u, T* v, T* x) const;  // correction of round-off's size
//     template <class T>  // d as a smooth function of p
//     void smoothed(const Point<T>& p, T* d) const;
//     std::string switchName(Index i) const;  // for messages
//
// A switching function that has no meaning in a mode returns -1 there.
#pragma once

#include <memory>
#include <utility>

#include "irk/ggl.h"
#include "irk/problem_system.h"

namespace irk {

/// The form y' = f(t, y) that codes for ordinary differential equations ask for: y = (u, v, x), f = (v, a, k), where
/// (a, k, z) solve the rows of `system` at acceleration level. It keeps scratch: one per thread.
template <class Real>
std::shared_ptr<const System<Real>> firstOrderForm(std::shared_ptr<const System<Real>> system);

/// The system of a problem struct P in the formulation that the options name. Throws Misuse for sizes that cannot be
/// and for options that the problem does not allow (see ProblemSystem).
template <class Real, class P>
std::shared_ptr<const System<Real>> makeSystem(P problem, const SystemOptions& options = {}) {
  if (options.formulation == Formulation::kFirstOrder) {
    return firstOrderForm<Real>(std::make_shared<const ProblemSystem<P, Real>>(std::move(problem), options));
  }
  if constexpr (requires(const Vec<Real>& u, Real* g) { problem.constraints(g[0], u, g); }) {
    if (options.formulation == Formulation::kGgl && problem.sizes().constraints > 0) {
      return std::make_shared<const GglSystem<P, Real>>(std::move(problem), options);
    }
  }
  return std::make_shared<const ProblemSystem<P, Real>>(std::move(problem), options);
}

}  // namespace irk
