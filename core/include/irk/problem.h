// Makes a System of a user's problem struct.
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
// `residual` writes every row: r.u (nu rows), r.x (nx), and r.z (nz - constraints rows, the algebraic equations
// that are not position constraints). T is double, a dual number or a multiprecision number: write
// `using std::sin;` and unqualified calls. Branches may compare values of T. Functions must not throw; what
// cannot be computed is NaN.
//
// A problem with switches keeps its mode in the discrete state p.d (sizes().discrete numbers) and has
// sizes().switches switching functions. Its residual depends on the mode through p.d only and never tests
// t, u, v or x itself:
//
//     template <class T>  // p.d is valid while all g <= 0
//     void switching(const Point<T>& p, T* g) const;
//     template <class T>  // switch i, due when g[i] > 0: changes d, a copy of p.d
//     void onSwitch(Index i, const Point<T>& p, T* d) const;
//
// Optional functions:
//
//     // Changes u, v, x where they jump at switch i; p.d is the new mode. With discontinuity `ignore` or
//     // `iterate` a problem with this function is refused.
//     template <class T>
//     void jump(Index i, const Point<T>& p, T* u, T* v, T* x) const;
//     // Sets those of u, v, x that the new mode p.d determines exactly, e.g. v of the belt after slip turns into
//     // stick. They are continuous at the switch: the change is as small as round-off.
//     template <class T>
//     void snap(Index i, const Point<T>& p, T* u, T* v, T* x) const;
//     // d as a smooth function of p, for discontinuity `smooth`.
//     template <class T>
//     void smoothed(const Point<T>& p, T* d) const;
//     std::string switchName(Index i) const;  // for messages
//     // Times, ascending, at which the residual jumps or has a kink. Steps end there; no root is searched. A jump
//     // must depend on p.d, which onTime changes; a kink (of a table of measured data) need not. onTime is not called
//     // at t_end and at times up to the start: the d of the start has to be the one after them.
//     std::vector<Real> times() const;
//     template <class T>
//     void onTime(Index i, const Point<T>& p, T* d) const;
//     // Changes u, v, x where they jump at time i, as at a blow or a dose; p.d is already the one after it. With every
//     // treatment of switches. Not at t_end and at times up to the start, as onTime.
//     template <class T>
//     void jumpAtTime(Index i, const Point<T>& p, T* u, T* v, T* x) const;
//
//     // Called with the end p of each accepted step that no switch has ended. Returns whether the step itself asks
//     // for another mode; then changes d, a copy of p.d, and u, v, x where they jump. The step control chooses where
//     // a step ends, so that the motion must not depend on it: as with a change of coordinates.
//     template <class T>
//     bool completeStep(const Point<T>& p, T* u, T* v, T* x, T* d) const;
//     bool completesSteps() const;  // false: completeStep need not be called
//
//     // Whether x_i is never negative on an exact solution, as a concentration is. A success with x_i below zero by
//     // more than a tolerance says so in a remark: reactions often run away from zero there.
//     bool nonNegative(Index i) const;
//
//     // Whether the residual reads p.v (true if the function is missing). That of an undamped motion does not; v is
//     // then computed at the ends of steps only. A residual that reads p.v all the same is refused at the start, and
//     // gets NaN later: comparisons with it are false.
//     bool usesVelocity() const;
//
// A switching function that has no meaning in a mode returns -1 in this mode.
//
// Algebraic unknowns other than multipliers have index 1, unless the struct declares `static constexpr int
// kAlgebraicIndex` (2 or 3). For index 3 it also declares an array of int, `static constexpr ... kDifferentialIndices`,
// with the index of each x: 2 where an algebraic unknown determines the derivative, else 1.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "irk/ggl.h"
#include "irk/problem_system.h"

namespace irk {

/// How often the first-order form factorizes a mass matrix (its whole D0) that is not constant.
enum class MassFactors {
  kEachPoint,  ///< at every new point
  /// Once per step, at its first point. Other solves of the step use these factors and are refined by residuals until
  /// they are as exact as with their own factors. If that does not converge, M is factorized at the point.
  kEachStep,
};

/// `system` in the form y' = f(t, y) that codes for ordinary differential equations need: y = (u, v, x) and
/// f = (v, a, k), where (a, k, z) solve the rows of `system` at acceleration level. Shares ownership of `system`.
/// The result keeps scratch: use one object per thread. Throws Misuse for an invalid system (irk/system_check.h); its
/// fromScene throws Misuse if (a, k, z) do not follow from (u, v, x).
template <class Real>
std::shared_ptr<const System<Real>> firstOrderForm(std::shared_ptr<const System<Real>> system, MassFactors factors);
/// The same with MassFactors::kEachPoint.
template <class Real>
std::shared_ptr<const System<Real>> firstOrderForm(std::shared_ptr<const System<Real>> system);

/// The system of a problem struct P in the formulation that the options name. Keeps a copy of the problem; the
/// result is immutable and may be shared by threads, except in the formulations kFirstOrder and kFirstOrderPerStep
/// (see firstOrderForm).
/// `kinks`: times, ascending, at which data that the problem reads has a kink (irk/table.h); they join its own times.
/// Throws Misuse for invalid sizes (irk/system_check.h) and for options that the problem does not allow
/// (see ProblemSystem).
template <class Real, class P>
std::shared_ptr<const System<Real>> makeSystem(P problem, const SystemOptions& options = {},
                                               const std::vector<Real>& kinks = {}) {
  if (options.formulation == Formulation::kFirstOrder || options.formulation == Formulation::kFirstOrderPerStep) {
    const bool each_point = options.formulation == Formulation::kFirstOrder;
    return firstOrderForm<Real>(std::make_shared<const ProblemSystem<P, Real>>(std::move(problem), options, kinks),
                                each_point ? MassFactors::kEachPoint : MassFactors::kEachStep);
  }
  if constexpr (requires(const Vec<Real>& u, Real* g) { problem.constraints(g[0], u, g); }) {
    if (options.formulation == Formulation::kGgl && problem.sizes().constraints > 0) {
      return std::make_shared<const GglSystem<P, Real>>(std::move(problem), options, kinks);
    }
  }
  return std::make_shared<const ProblemSystem<P, Real>>(std::move(problem), options, kinks);
}

}  // namespace irk
