// The one equation: r(t; u, v, x; a, k, z) = 0 with v = u', a = u'', k = x'.
#pragma once

#include <string>
#include <vector>

#include "irk/scalar.h"
#include "irk/strategy_id.h"

namespace irk {

/// Numbers of unknowns: nu second-order, nx first-order, nz algebraic. The residual has n rows,
/// ordered like the stage unknown w = (a, k, z).
struct Sizes {
  Index nu = 0;
  Index nx = 0;
  Index nz = 0;
  /// How many of the nz algebraic unknowns are multipliers of position constraints g(t, u) = 0.
  /// They come first in z.
  Index constraints = 0;
  /// Size of the discrete state, which changes at switches only.
  Index discrete = 0;
  /// Switching functions.
  Index switches = 0;

  Index n() const { return nu + nx + nz; }
  /// Components of the state (u, v, x, z).
  Index components() const { return 2 * nu + nx + nz; }
};

/// Where the residual is evaluated. Views: the caller owns the numbers, nothing is copied.
template <class T>
struct Point {
  T t;
  ConstVec<T> u, v, x;
  ConstVec<T> a, k, z;
  ConstVec<T> d{nullptr, 0};  ///< discrete state
};

/// The state between two steps, with the last known w = (a, k, z) as start values of the next step.
template <class Real>
struct State {
  Real t{};
  Vec<Real> u, v, x;
  Vec<Real> w;
  Vec<Real> d;  ///< discrete state: constant between switches
  /// What the additions of the steps' increments to (u, v, x) lost to round-off, 2 nu + nx:
  /// compensated summation, Hairer, Lubich & Wanner, Geometric Numerical Integration, VIII.5.
  Vec<Real> carry;

  explicit State(const Sizes& n = {})
      : u(Vec<Real>::Zero(n.nu)),
        v(Vec<Real>::Zero(n.nu)),
        x(Vec<Real>::Zero(n.nx)),
        w(Vec<Real>::Zero(n.n())),
        d(Vec<Real>::Zero(n.discrete)),
        carry(Vec<Real>::Zero(2 * n.nu + n.nx)) {}
  auto a() { return w.head(u.size()); }
  auto a() const { return w.head(u.size()); }
  auto k() { return w.segment(u.size(), x.size()); }
  auto k() const { return w.segment(u.size(), x.size()); }
  auto z() { return w.tail(w.size() - u.size() - x.size()); }
  auto z() const { return w.tail(w.size() - u.size() - x.size()); }
};

/// Views of a state's numbers.
template <class Real>
Point<Real> pointOf(const State<Real>& s) {
  const Real* const w = s.w.data();
  const Index nu = s.u.size(), nx = s.x.size();
  return {s.t,
          {s.u.data(), nu},
          {s.v.data(), nu},
          {s.x.data(), nx},
          {w, nu},
          {w + nu, nx},
          {w + nu + nx, s.w.size() - nu - nx},
          {s.d.data(), s.d.size()}};
}

/// Points with one discrete state: the stages of a step, by columns.
template <class Real>
struct StagePoints {
  Sizes sizes;
  const Real* t;
  const Real *u, *v, *x;  ///< columns of nu, nu, nx
  const Real* w;          ///< columns of n: (a, k, z)
  const Real* d;

  Point<Real> operator[](Index i) const {
    const Index nu = sizes.nu, nx = sizes.nx;
    const Real* const wi = w + i * sizes.n();
    return {t[i],     {u + i * nu, nu}, {v + i * nu, nu},         {x + i * nx, nx},
            {wi, nu}, {wi + nu, nx},    {wi + nu + nx, sizes.nz}, {d, sizes.discrete}};
  }
};

/// Which discrete state a residual takes.
enum class ModeSeen {
  kFrozen,       ///< that of its point
  kImplied,      ///< the one that (u, v, x; a, k, z) of its point imply
  kRegularised,  ///< the problem's regularisation: a smooth function of its point
};
/// What a switch inside a step does to the step.
enum class AtSwitch {
  kGoOn,   ///< the step goes on over it
  kEnd,    ///< the step ends there
  kNever,  ///< nothing switches
};

/// How switches are treated: what the system has to know of it. What follows a solved step and its acceptance:
/// core/steps/modes.h.
struct Discontinuity : StrategyId<Discontinuity> {
  ModeSeen sees = ModeSeen::kFrozen;
  AtSwitch at_switch = AtSwitch::kGoOn;

  /// Jumps are left to the error estimate.
  static const Discontinuity kIgnore;
  /// Modes are updated after Newton's method, the step repeated until they stay.
  static const Discontinuity kIterate;
  /// The first root of a switching function ends the step, then a restart.
  static const Discontinuity kLocate;
  static const Discontinuity kSmooth;
};
inline constexpr Discontinuity Discontinuity::kIgnore{{"ignore"}, ModeSeen::kImplied, AtSwitch::kGoOn};
inline constexpr Discontinuity Discontinuity::kIterate{{"iterate"}, ModeSeen::kFrozen, AtSwitch::kGoOn};
inline constexpr Discontinuity Discontinuity::kLocate{{"locate"}, ModeSeen::kFrozen, AtSwitch::kEnd};
inline constexpr Discontinuity Discontinuity::kSmooth{{"smooth"}, ModeSeen::kRegularised, AtSwitch::kNever};

/// Which residual. `kFormulated` is the one that is integrated; the others replace its rows of
/// position constraints g(t, u) = 0 by g, dg/dt or d2g/dt2, whatever the formulation: to check a
/// start, to measure drift, and (`kAcceleration`) to determine (a, k, z) from (u, v, x).
enum class Level { kFormulated, kPosition, kVelocity, kAcceleration };

/// Index minus 1 of each component: the error of a variable of index i is O(h^-(i-1)) times larger, HW II
/// (VII.7). The error norm multiplies that of algebraic unknowns by h^power; u, v and x are results, and
/// controlled as they are: a method that does not determine them fails. Newton's increments carry h^power
/// in all of them. Sizes: nu, nu, nx, nz.
struct ErrorPowers {
  std::vector<int> u, v, x, z;
};

/// A system in residual form. Immutable and shared by threads: evaluation has no side
/// effects (but FirstOrderForm, which keeps its factors: one per thread).
template <class Real>
class System {
 public:
  virtual ~System() = default;

  virtual Sizes sizes() const = 0;
  /// Those of the scene's unknowns, which fromScene takes.
  virtual Sizes sceneSizes() const { return sizes(); }

  /// r (n rows) at p. No aliasing between p and r. Writes every row; never throws; what cannot be
  /// computed is NaN.
  virtual void evaluate(Level level, const Point<Real>& p, VecView<Real> r) const = 0;
  virtual void evaluate(Level level, const Point<Dual<Real>>& p, VecView<Dual<Real>> r) const = 0;

  /// The formulated residuals at the points first <= i < last: column i of r. One call for all stages,
  /// for which a small system overrides it: there calls cost as much as its arithmetic.
  virtual void evaluateStages(const StagePoints<Real>& at, Index first, Index last, Real* r) const {
    const Index n = at.sizes.n();
    for (Index i = first; i < last; ++i) {
      evaluate(Level::kFormulated, at[i], VecView<Real>(r + i * n, n));
    }
  }

  /// Row i of the formulated residual is multiplied by h^-power[i] (paper, section 4: 1/h for
  /// velocity constraints; 1/h^2 for position constraints). Size n.
  virtual const std::vector<int>& rowPowers() const = 0;
  virtual const ErrorPowers& errorPowers() const = 0;

  /// Which switching functions exist follows from sizes(). g (sizes().switches): the discrete state
  /// of p is valid while every g_i <= 0; g_i > 0 says that switch i is due.
  virtual void switching(const Point<Real>& p, VecView<Real> g) const {
    static_cast<void>(p);
    g.setConstant(Real(-1));
  }
  /// The discrete state after switch i.
  virtual void onSwitch(Index i, State<Real>& state) const {
    static_cast<void>(i);
    static_cast<void>(state);
  }
  /// u, v, x after switch i, where the problem makes them jump or knows them exactly; state.d is the
  /// new one.
  virtual void jump(Index i, State<Real>& state) const {
    static_cast<void>(i);
    static_cast<void>(state);
  }
  /// Times at which the right-hand side jumps or has a kink, ascending. A step ends at each of them, whatever the
  /// treatment of switches is, and the integration starts again from there.
  virtual std::vector<Real> times() const { return {}; }
  /// The discrete state after time i.
  virtual void onTime(Index i, State<Real>& state) const {
    static_cast<void>(i);
    static_cast<void>(state);
  }
  /// For messages: "contact".
  virtual std::string switchName(Index i) const { return std::to_string(i); }
  /// How its evaluations treat the discrete state.
  virtual Discontinuity discontinuity() const { return Discontinuity::kIgnore; }
  /// Whether v is projected on dg/dt = 0 after each step.
  virtual bool projectsVelocity() const { return false; }

  /// Translate between the scene's unknowns (u, v, x, z as the problem names them) and the
  /// formulation's. Identity for all but GGL and first order.
  virtual State<Real> fromScene(const State<Real>& scene) const = 0;
  virtual State<Real> toScene(const State<Real>& state) const = 0;
  /// Whether a = u'' is an unknown of its own (in GGL and first order it is part of k).
  virtual bool secondOrder() const { return true; }
};

}  // namespace irk
