// The one equation: r(t; u, v, x; a, k, z) = 0 with v = u', a = u'', k = x'.
#pragma once

#include <algorithm>
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
  bool operator==(const Sizes&) const = default;
};

/// A point where the residual is evaluated. Views: the caller owns the numbers, and nothing is copied.
template <class T>
struct Point {
  T t;
  ConstVec<T> u, v, x;
  ConstVec<T> a, k, z;
  ConstVec<T> d{nullptr, 0};  ///< discrete state
};

/// The state between two steps. Sizes: u and v nu, x nx, w n, d the number of discrete states. w = (a, k, z) serves as
/// start values of the next step.
template <class Real>
struct State {
  Real t{};
  Vec<Real> u, v, x;
  Vec<Real> w;
  Vec<Real> d;  ///< discrete state: constant between switches
  /// The round-off that was lost when the increments of steps were added to (u, v, x); 2 nu + nx numbers. Compensated
  /// summation, Hairer, Lubich & Wanner, Geometric Numerical Integration, VIII.5.
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

/// The point of a state, as views of its numbers: valid as long as the state.
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

/// Points with a common discrete state: the stages of a step, one per column.
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

/// The discrete state with which a residual is evaluated.
enum class ModeSeen {
  kFrozen,       ///< the discrete state of the point
  kImplied,      ///< the one that (u, v, x; a, k, z) of the point imply
  kRegularised,  ///< the problem's regularisation: a smooth function of the point
};
/// The effect of a switch inside a step on the step.
enum class AtSwitch {
  kGoOn,   ///< the step goes on over the switch
  kEnd,    ///< the step ends at the switch
  kNever,  ///< nothing switches
};

/// The treatment of switches, as far as the system needs it. core/steps/modes.h has the part that follows a solved step
/// and its acceptance.
struct Discontinuity : StrategyId<Discontinuity> {
  ModeSeen sees = ModeSeen::kFrozen;
  AtSwitch at_switch = AtSwitch::kGoOn;

  /// Steps go on over switches; the error estimate has to judge the jumps.
  static const Discontinuity kIgnore;
  /// The mode is updated after Newton's method, and the step is repeated until the mode stays the same.
  static const Discontinuity kIterate;
  /// The first root of a switching function ends the step; then the integration restarts.
  static const Discontinuity kLocate;
  /// Residuals use the problem's regularisation; nothing switches.
  static const Discontinuity kSmooth;
};
inline constexpr Discontinuity Discontinuity::kIgnore{{"ignore"}, ModeSeen::kImplied, AtSwitch::kGoOn};
inline constexpr Discontinuity Discontinuity::kIterate{{"iterate"}, ModeSeen::kFrozen, AtSwitch::kGoOn};
inline constexpr Discontinuity Discontinuity::kLocate{{"locate"}, ModeSeen::kFrozen, AtSwitch::kEnd};
inline constexpr Discontinuity Discontinuity::kSmooth{{"smooth"}, ModeSeen::kRegularised, AtSwitch::kNever};

/// Which residual is evaluated. `kFormulated` is the one that is integrated. In the others the rows of position
/// constraints are g, dg/dt or d2g/dt2 in every formulation: to check a start, to measure drift, and (`kAcceleration`)
/// to determine (a, k, z) from (u, v, x).
enum class Level { kFormulated, kPosition, kVelocity, kAcceleration };

/// Index minus 1 of each component: the error of a variable of index i is larger by a factor O(h^-(i-1)), HW II
/// (VII.7). The error norm multiplies the errors of algebraic unknowns by h^power. It does not do so for u, v and x,
/// which are results: a method that does not determine them must fail. Newton's increments are multiplied by h^power in
/// all components. Sizes: nu, nu, nx, nz.
struct ErrorPowers {
  std::vector<int> u, v, x, z;
  bool operator==(const ErrorPowers&) const = default;

  /// Whether velocities have index 2: the constraints are those of positions (index 3), and velocities satisfy
  /// dg/dt = 0 only to the error of a step.
  bool isIndex3() const {
    return std::any_of(v.begin(), v.end(), [](int power) { return power > 0; });
  }
};

/// A system in residual form. Evaluations have no side effects, so that threads may share a system; FirstOrderForm is
/// the exception: it keeps factors and needs one object per thread.
template <class Real>
class System {
 public:
  virtual ~System() = default;

  virtual Sizes sizes() const = 0;
  /// The sizes in the scene's unknowns, which fromScene takes.
  virtual Sizes sceneSizes() const { return sizes(); }

  /// Writes every row of the residual at p to r (n rows); r and p must not overlap. Never throws: a value that cannot
  /// be computed is NaN.
  virtual void evaluate(Level level, const Point<Real>& p, VecView<Real> r) const = 0;
  virtual void evaluate(Level level, const Point<Dual<Real>>& p, VecView<Dual<Real>> r) const = 0;

  /// Writes the formulated residuals at the points first <= i < last to last - first columns of r. Small systems
  /// override it, because there a call costs as much as its arithmetic.
  virtual void evaluatePoints(const StagePoints<Real>& at, Index first, Index last, Real* r) const {
    const Index n = at.sizes.n();
    for (Index i = first; i < last; ++i) {
      evaluate(Level::kFormulated, at[i], VecView<Real>(r + (i - first) * n, n));
    }
  }
  /// The same for the stages of a step, to the columns i of r: for systems that keep something as long as a step lasts.
  virtual void evaluateStages(const StagePoints<Real>& at, Index first, Index last, Real* r) const {
    evaluatePoints(at, first, last, r + first * at.sizes.n());
  }

  /// Row i of the formulated residual is multiplied by h^-power[i] (paper, section 4: 1/h for velocity constraints,
  /// 1/h^2 for position constraints). n numbers.
  virtual const std::vector<int>& rowPowers() const = 0;
  virtual const ErrorPowers& errorPowers() const = 0;

  /// Writes the sizes().switches switching functions at p to g. The discrete state of p is valid while every g_i <= 0;
  /// g_i > 0: switch i is due.
  virtual void switching(const Point<Real>& p, VecView<Real> g) const {
    static_cast<void>(p);
    g.setConstant(Real(-1));
  }
  /// Changes state.d to the discrete state after switch i.
  virtual void onSwitch(Index i, State<Real>& state) const {
    static_cast<void>(i);
    static_cast<void>(state);
  }
  /// Changes u, v, x at switch i where the problem makes them jump or knows them exactly; state.d is the new discrete
  /// state.
  virtual void jump(Index i, State<Real>& state) const {
    static_cast<void>(i);
    static_cast<void>(state);
  }
  /// Times, ascending, at which the right-hand side jumps or has a kink. With every treatment of switches a step ends
  /// at each of them, and the integration restarts there.
  virtual std::vector<Real> times() const { return {}; }
  /// Changes state.d to the discrete state after time i.
  virtual void onTime(Index i, State<Real>& state) const {
    static_cast<void>(i);
    static_cast<void>(state);
  }
  /// Changes u, v, x at time i where the problem makes them jump; called after onTime.
  virtual void jumpAtTime(Index i, State<Real>& state) const {
    static_cast<void>(i);
    static_cast<void>(state);
  }
  /// Whether completeStep has to be called. A system that needs it has a discrete state.
  virtual bool completesSteps() const { return false; }
  /// Called with the end of each accepted step that no switch has ended. A step may itself ask for another mode, as one
  /// of an FMU that chooses other states then: changes state.d, and u, v, x where they jump, and returns true. The
  /// integration restarts there. Not called at the start.
  virtual bool completeStep(State<Real>& state) const {
    static_cast<void>(state);
    return false;
  }
  /// Whether x_i of the scene's unknowns is never negative on an exact solution, as a concentration is.
  virtual bool nonNegative(Index i) const {
    static_cast<void>(i);
    return false;
  }
  /// Whether the formulated residual depends on v. If not, the v of stages are NaN: a residual that computes with them
  /// all the same is not finite. (Comparisons with NaN are false; requireStart looks for them at the start only.)
  virtual bool usesVelocity() const { return true; }
  /// The name of switch i in messages, e.g. "contact".
  virtual std::string switchName(Index i) const { return std::to_string(i); }
  /// The position constraints that are left out (SystemOptions::left_out). At kPosition and kVelocity their rows are
  /// still g and dg/dt, so that a violation is seen; otherwise z_i.
  virtual const std::vector<Index>& leftOut() const {
    static const std::vector<Index> none;
    return none;
  }
  /// How evaluations treat the discrete state.
  virtual Discontinuity discontinuity() const { return Discontinuity::kIgnore; }
  /// Whether v is projected on dg/dt = 0 after each step.
  virtual bool projectsVelocity() const { return false; }

  /// Translate between the scene's unknowns (u, v, x, z as the problem names them) and those of the formulation. The
  /// identity for all formulations but GGL and first order.
  virtual State<Real> fromScene(const State<Real>& scene) const = 0;
  virtual State<Real> toScene(const State<Real>& state) const = 0;
  /// Whether a = u'' is an unknown of its own (in GGL and first order it is part of k).
  virtual bool secondOrder() const { return true; }
};

}  // namespace irk
