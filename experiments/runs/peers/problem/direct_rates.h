// The right-hand side of a system whose mass matrix is diagonal and constant, without solving for it.
#pragma once

#include <cstdint>
#include <new>

#include "experiments/runs/peers/problem/scene_problem.h"
#include "irk/system.h"

namespace irk {

/// f = (v, a, k) for y = (u, v, x) where the residual is r0(t, y) + D0 (a, k) with a constant diagonal D0 and without
/// algebraic unknowns. FirstOrderForm (core/derivatives/first_order.h) computes the same numbers for any D0; here
/// nothing is copied, compared or factorized, which takes several times as long as a small residual. Use one object per
/// thread.
class DirectRates {
 public:
  /// Keeps a reference to the system, which is not in first-order form.
  explicit DirectRates(const System<double>& system);
  DirectRates(const DirectRates&) = delete;
  DirectRates& operator=(const DirectRates&) = delete;

  /// Looks at D0 near the point and keeps it if it is as above; else `known` becomes false. Sizes: y 2 nu + nx, d the
  /// discrete state. To be called at the start and after each change of the discrete state.
  void look(double t, const double* y, const Vec<double>& d);
  void forget() { known_ = false; }
  bool known() const { return known_; }

  /// Writes f(t, y). Returns whether all of it is finite.
  bool evaluate(double t, const double* y, double* f) {
    pointTo(t, y);
    system_.evaluate(Level::kAcceleration, point_, {f + sizes_.nu, rows_});
    if (!is_residual_) complete(y, f);
    return areFinite(f + sizes_.nu, rows_);
  }
  /// Writes df/dy by columns, unless `dfdy` is null, and df/dt, unless `dfdt` is null. Returns whether all of it is
  /// finite. Adds the evaluations with dual numbers to `evaluations`. If D0 is another one here than it was where
  /// `look` was called, `known` becomes false, and what was written is wrong.
  bool differentiate(double t, const double* y, double* dfdy, double* dfdt, std::int64_t& evaluations);
  /// If f(t, y) does not solve the residual, `known` becomes false.
  void check(double t, const double* y);

 private:
  // A Map is pointed to other numbers by constructing it anew.
  void pointTo(double t, const double* y) {
    const Index nu = sizes_.nu;
    point_.t = t;
    new (&point_.u) ConstVec<double>(y, nu);
    new (&point_.v) ConstVec<double>(y + nu, nu);
    new (&point_.x) ConstVec<double>(y + 2 * nu, sizes_.nx);
  }
  void complete(const double* y, double* f) const;
  void divide(double* rates) const;
  void pointRatesTo(const double* rates) {
    new (&point_.a) ConstVec<double>(rates, sizes_.nu);
    new (&point_.k) ConstVec<double>(rates + sizes_.nu, sizes_.nx);
  }
  void checkAt();
  bool massNear(double t, const double* y, Vec<double>& mass);
  Point<Dual<double>> dualPoint(double t, const double* y);

  const System<double>& system_;
  Sizes sizes_;
  Index rows_;  // nu + nx
  bool known_ = false;
  Vec<double> mass_;          // the diagonal of D0
  bool is_residual_ = false;  // f is the residual at (a, k) = 0, that is f - k there: nu = 0 and D0 = -I
  Vec<double> no_rates_, d_;
  Point<double> point_;  // with (a, k) = 0
  Vec<double> rates_, residual_;
  Vec<Dual<double>> dual_y_, dual_w_, dual_d_, dual_residual_;  // directions are 0 between two calls
};

}  // namespace irk
