// A problem struct as a System: its residual, its constraints at the level of the formulation, its switches.
#pragma once

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "irk/constraint_views.h"
#include "irk/misuse.h"
#include "irk/system_check.h"
#include "irk/system_options.h"

namespace irk {

/// Views of the rows of a residual, which a problem writes. z: the nz - constraints rows of the algebraic equations
/// other than position constraints.
template <class T>
struct Rows {
  VecView<T> u, x, z;
};

/// Groups of up to this many numbers are copied without allocating memory.
constexpr std::size_t kFew = 16;

/// A problem struct P in one formulation (all but GGL, core/include/irk/ggl.h), over one scalar.
template <class P, class Real>
class ProblemSystem final : public System<Real> {
 public:
  /// Throws Misuse for invalid sizes and times (core/include/irk/system_check.h), for unknown options, for `smooth`
  /// with a problem that switches but has no regularisation, and for `ignore` and `iterate` with a problem whose state
  /// jumps, since they go on over switches. `kinks`: times, ascending, at which data that the problem reads has a kink;
  /// they join the problem's own times.
  ProblemSystem(P problem, const SystemOptions& options, const std::vector<Real>& kinks = {})
      : problem_(std::move(problem)), options_(options), sizes_(problem_.sizes()) {
    validate(options);
    requireSizes(sizes_, {.constraints = kHasConstraints, .switching = kHasSwitching});
    if (smooth() && kHasSwitching && !kHasSmoothed) {
      throw Misuse(
          "illegal combination: discontinuity 'smooth' with a scene that has no "
          "regularisation: its discrete state is a memory");
    }
    const bool goes_on = options.discontinuity.at_switch == AtSwitch::kGoOn;
    if (goes_on && kHasJump && sizes_.switches > 0) {
      throw Misuse(
          "illegal combination: discontinuity 'ignore' or 'iterate' with a scene whose state jumps at "
          "switches: steps go on over them; use 'locate'");
    }
    setTimes(kinks);
    const int index = constraintIndex();
    const auto all = [](Index n, int power) { return std::vector<int>(static_cast<std::size_t>(n), power); };
    row_powers_ = all(sizes_.n(), 0);
    error_powers_ = {all(sizes_.nu, 0), all(sizes_.nu, index == 3 && sizes_.constraints > 0 ? 1 : 0), all(sizes_.nx, 0),
                     all(sizes_.nz, algebraicIndex() - 1)};
    for (Index i = 0; i < sizes_.nx; ++i) {
      error_powers_.x[static_cast<std::size_t>(i)] = differentialIndex(i) - 1;
    }
    for (Index i = 0; i < sizes_.nz; ++i) {
      const bool constraint = i < sizes_.constraints;
      const int power = (constraint ? index : algebraicIndex()) - 1;
      error_powers_.z[static_cast<std::size_t>(i)] = power;
      if (options.scaling == ConstraintScaling::kOn) {
        row_powers_[static_cast<std::size_t>(sizes_.nu + sizes_.nx + i)] = power;
      }
    }
    for (const Index i : options_.left_out) {
      if (i < 0 || i >= sizes_.constraints) {
        throw Misuse("left_out: constraint " + std::to_string(i) + ": the problem has " +
                     std::to_string(sizes_.constraints) + ", numbered from 0 on");
      }
      error_powers_.z[static_cast<std::size_t>(i)] = 0;
      row_powers_[static_cast<std::size_t>(sizes_.nu + sizes_.nx + i)] = 0;
    }
  }

  Sizes sizes() const override { return sizes_; }
  void evaluate(Level level, const Point<Real>& p, VecView<Real> r) const override {
    if (level == Level::kFormulated) return formulated(p, r.data());
    evaluateAt(level, p, r.data());
  }
  void evaluate(Level level, const Point<Dual<Real>>& p, VecView<Dual<Real>> r) const override {
    evaluateAt(level, p, r.data());
  }
  void evaluatePoints(const StagePoints<Real>& at, Index first, Index last, Real* r) const override {
    for (Index i = first; i < last; ++i) atPoint(at, i, r + (i - first) * sizes_.n());
  }
  void switching(const Point<Real>& p, VecView<Real> g) const override {
    if constexpr (kHasSwitching) problem_.switching(p, g.data());
  }
  void onSwitch(Index i, State<Real>& state) const override {
    if constexpr (kHasSwitching) {
      change(state, [&](const Point<Real>& p, Real* d) { problem_.onSwitch(i, p, d); });
    }
  }
  void jump(Index i, State<Real>& state) const override {
    if constexpr (kHasJump) {
      move(state, [&](const Point<Real>& p, Real* u, Real* v, Real* x) { problem_.jump(i, p, u, v, x); });
    }
    if constexpr (kHasSnap) {
      move(state, [&](const Point<Real>& p, Real* u, Real* v, Real* x) { problem_.snap(i, p, u, v, x); });
    }
  }
  std::vector<Real> times() const override { return times_; }
  void onTime(Index i, State<Real>& state) const override {
    const Index own = own_time_[static_cast<std::size_t>(i)];
    if constexpr (requires(const Point<Real>& p, Real* d) { problem_.onTime(own, p, d); }) {
      if (own >= 0) change(state, [&](const Point<Real>& p, Real* d) { problem_.onTime(own, p, d); });
    }
  }
  void jumpAtTime(Index i, State<Real>& state) const override {
    const Index own = own_time_[static_cast<std::size_t>(i)];
    if constexpr (requires(const Point<Real>& p, Real* y) { problem_.jumpAtTime(own, p, y, y, y); }) {
      if (own < 0) return;
      move(state, [&](const Point<Real>& p, Real* u, Real* v, Real* x) { problem_.jumpAtTime(own, p, u, v, x); });
    }
  }
  bool completesSteps() const override {
    if constexpr (requires { problem_.completesSteps(); }) return problem_.completesSteps();
    return kHasCompleteStep;
  }
  bool completeStep(State<Real>& state) const override {
    bool asked = false;
    if constexpr (kHasCompleteStep) {
      State<Real> next = state;
      asked = problem_.completeStep(pointOf(state), next.u.data(), next.v.data(), next.x.data(), next.d.data());
      if (asked) state = next;
    }
    return asked;
  }
  bool nonNegative(Index i) const override {
    if constexpr (requires { problem_.nonNegative(i); }) return problem_.nonNegative(i);
    return System<Real>::nonNegative(i);
  }
  bool usesVelocity() const override {
    // Constraints at velocity and acceleration level read v, and switching functions may.
    const bool constrained = sizes_.constraints > 0 && constraintIndex() != 3;
    if constexpr (requires { problem_.usesVelocity(); }) {
      return problem_.usesVelocity() || constrained || sizes_.switches > 0;
    }
    return true;
  }
  std::string switchName(Index i) const override {
    if constexpr (requires { problem_.switchName(i); }) return problem_.switchName(i);
    return System<Real>::switchName(i);
  }
  const std::vector<Index>& leftOut() const override { return options_.left_out; }
  Discontinuity discontinuity() const override { return options_.discontinuity; }
  bool projectsVelocity() const override {
    return options_.formulation == Formulation::kIndex2Projected && sizes_.constraints > 0;
  }
  const std::vector<int>& rowPowers() const override { return row_powers_; }
  const ErrorPowers& errorPowers() const override { return error_powers_; }
  State<Real> fromScene(const State<Real>& scene) const override { return scene; }
  State<Real> toScene(const State<Real>& state) const override { return state; }

  /// All rows at p, with the discrete state that the option `discontinuity` selects.
  template <class T>
  void evaluateAt(Level level, const Point<T>& p, T* r) const {
    const bool implied = kHasSwitching && options_.discontinuity.sees == ModeSeen::kImplied;
    if (sizes_.switches == 0 || !(implied || smooth())) return evaluateFrozen(level, p, r);
    FewOrMany<T> d(p.d.data(), p.d.data() + p.d.size());
    const Point<T> at{p.t, p.u, p.v, p.x, p.a, p.k, p.z, {d.data(), p.d.size()}};
    if (smooth()) {
      if constexpr (kHasSmoothed) problem_.smoothed(p, d.data());
    } else {
      imply(at, d);
    }
    evaluateFrozen(level, at, r);
  }

  /// g, dg/dt or d2g/dt2 at p.
  template <class T>
  void constraintRows(Level level, const Point<T>& p, T* g) const {
    if constexpr (requires { problem_.constraints(p.t, p.u, g); }) {
      if (level == Level::kVelocity) {
        problem_.constraints(Rate<T>{p.t, T(1.0)}, detail::VelocityView<T>{p.u, p.v},
                             detail::SinkRow<detail::RateSink<T>, T>{g});
      } else if (level == Level::kAcceleration) {
        problem_.constraints(Rate<Rate<T>>{{p.t, T(1.0)}, {T(1.0), T(0.0)}}, detail::AccelerationView<T>{p.u, p.v, p.a},
                             detail::SinkRow<detail::SecondRateSink<T>, T>{g});
      } else {
        problem_.constraints(p.t, p.u, g);
      }
    }
  }

  /// Replaces the rows of the constraints that are left out by their multipliers z, or mu.
  template <class T>
  void leaveOut(ConstVec<T> multipliers, T* rows) const {
    for (const Index i : options_.left_out) rows[i] = multipliers[i];
  }

  const P& problem() const { return problem_; }

 private:
  static constexpr bool kHasConstraints = requires(const P& problem, const Point<Real>& p, Real* g) {
    problem.constraints(p.t, p.u, g);
  };
  static constexpr bool kHasSwitching = requires(const P& problem, const Point<Real>& p, Real* out) {
    problem.switching(p, out);
  };
  static constexpr bool kHasJump = requires(const P& problem, const Point<Real>& p, Real* out) {
    problem.jump(Index(0), p, out, out, out);
  };
  static constexpr bool kHasSnap = requires(const P& problem, const Point<Real>& p, Real* out) {
    problem.snap(Index(0), p, out, out, out);
  };
  static constexpr bool kHasCompleteStep = requires(const P& problem, const Point<Real>& p, Real* out) {
    problem.completeStep(p, out, out, out, out);
  };
  static constexpr bool kHasSmoothed = requires(const P& problem, const Point<Real>& p, Real* out) {
    problem.smoothed(p, out);
  };

  static constexpr bool kHasTimes = requires(const P& problem) { problem.times(); };

  // The problem's times and the kinks, ascending and each once.
  void setTimes(const std::vector<Real>& kinks) {
    std::vector<Real> own;
    if constexpr (kHasTimes) requireTimes(own = problem_.times());
    for (std::size_t i = 0, k = 0; i < own.size() || k < kinks.size();) {
      const bool kink = i == own.size() || (k < kinks.size() && kinks[k] < own[i]);
      if (!kink && k < kinks.size() && kinks[k] == own[i]) ++k;
      own_time_.push_back(kink ? -1 : static_cast<Index>(i));
      times_.push_back(kink ? kinks[k++] : own[i++]);
    }
  }

  // Calls f(p, d) with the state and the discrete states that f may change.
  template <class F>
  static void change(State<Real>& state, F&& f) {
    FewOrMany<Real> d(state.d.begin(), state.d.end());
    f(pointOf(state), d.data());
    std::copy(d.begin(), d.end(), state.d.begin());
  }

  // Calls f(p, u, v, x) with the state and the numbers that f may change.
  template <class F>
  static void move(State<Real>& state, F&& f) {
    FewOrMany<Real> u(state.u.begin(), state.u.end()), v(state.v.begin(), state.v.end()),
        x(state.x.begin(), state.x.end());
    f(pointOf(state), u.data(), v.data(), x.data());
    std::copy(u.begin(), u.end(), state.u.begin());
    std::copy(v.begin(), v.end(), state.v.begin());
    std::copy(x.begin(), x.end(), state.x.begin());
  }

  template <class T>
  using FewOrMany = boost::container::small_vector<T, kFew>;

  // Neither is inlined: the compiler would contract other products and sums at each place, and the bits would depend on
  // the number of points per call.
  [[gnu::noinline]] void formulated(const Point<Real>& p, Real* r) const { evaluateAt(Level::kFormulated, p, r); }
  [[gnu::noinline]] void atPoint(const StagePoints<Real>& at, Index i, Real* r) const {
    evaluateAt(Level::kFormulated, at[i], r);
  }
  bool smooth() const { return options_.discontinuity.sees == ModeSeen::kRegularised; }

  /// The index of algebraic unknowns other than multipliers: P::kAlgebraicIndex, or 1 if P has none.
  static int algebraicIndex() {
    if constexpr (requires { P::kAlgebraicIndex; }) return P::kAlgebraicIndex;
    return 1;
  }
  /// The index of x_i: P::kDifferentialIndices[i], or 1 if P has none. It is 2 where an algebraic unknown of index 3
  /// determines the derivative.
  static int differentialIndex(Index i) {
    if constexpr (requires { P::kDifferentialIndices; }) {
      return P::kDifferentialIndices[static_cast<std::size_t>(i)];
    }
    static_cast<void>(i);
    return 1;
  }
  int constraintIndex() const {
    switch (options_.formulation) {
      case Formulation::kIndex3:
        return 3;
      case Formulation::kIndex1:
      case Formulation::kFirstOrder:
      case Formulation::kFirstOrderPerStep:
        return 1;
      case Formulation::kIndex2:
      case Formulation::kIndex2Projected:
      case Formulation::kGgl:
        return 2;
    }
    return 2;
  }

  // Computes the mode that p implies: carries out due switches until none is due. A cascade that does not end is cut
  // off; the error estimate then judges the step.
  template <class T>
  void imply(const Point<T>& p, FewOrMany<T>& d) const {
    if constexpr (kHasSwitching) {
      FewOrMany<T> g(static_cast<std::size_t>(sizes_.switches));
      for (Index pass = 0; pass < 2 * sizes_.switches; ++pass) {
        problem_.switching(p, g.data());
        Index due = 0;
        while (due < sizes_.switches && !(g[static_cast<std::size_t>(due)] > T(0.0))) ++due;
        if (due == sizes_.switches) return;
        FewOrMany<T> next = d;
        problem_.onSwitch(due, p, next.data());
        d = next;
      }
    }
  }

  template <class T>
  void evaluateFrozen(Level level, const Point<T>& p, T* r) const {
    const Index nc = sizes_.constraints;
    T* g = r + sizes_.nu + sizes_.nx;
    problem_.residual(
        p, Rows<T>{VecView<T>(r, sizes_.nu), VecView<T>(r + sizes_.nu, sizes_.nx), VecView<T>(g + nc, sizes_.nz - nc)});
    if (nc > 0) constraintRows(constraintLevel(level), p, g);
    if (level == Level::kFormulated || level == Level::kAcceleration) leaveOut(p.z, g);
  }

  Level constraintLevel(Level level) const {
    if (level != Level::kFormulated) return level;
    switch (constraintIndex()) {
      case 3:
        return Level::kPosition;
      case 2:
        return Level::kVelocity;
      default:
        return Level::kAcceleration;
    }
  }

  P problem_;
  SystemOptions options_;
  Sizes sizes_;
  std::vector<int> row_powers_;
  ErrorPowers error_powers_;
  std::vector<Real> times_;
  std::vector<Index> own_time_;  // for each of them its number among the problem's times, or -1 for a kink
};

}  // namespace irk
