// A decorator that turns a system around in time, so that an integration backward in time is one forward.
#pragma once

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "irk/misuse.h"
#include "irk/system.h"

namespace irk {

/// -x, but 0 for 0: a time or velocity of 0 is not printed as -0.
template <class T>
T opposite(const T& x) {
  return T(0.0) - x;
}

/// The state in the time -t: t, v and k change their signs. `count` components of x from `first` on are velocities (of
/// GGL and the first-order form): these change their signs, and their rates do not.
template <class Real>
State<Real> reversed(State<Real> state, Index first = 0, Index count = 0) {
  const Index nu = state.u.size();
  const auto turn = [](auto numbers) {
    for (Real& number : numbers) number = opposite(number);
  };
  state.t = opposite(state.t);
  turn(state.v.segment(0, nu));
  turn(state.k());
  turn(state.carry.segment(nu, nu));
  turn(state.x.segment(first, count));
  turn(state.k().segment(first, count));
  turn(state.carry.segment(2 * nu + first, count));
  return state;
}

/// A system over tau = -t: u, a, x, z are those of `inner`, v = du/dtau and k = dx/dtau have the opposite signs. Its
/// scene has the same signs: callers translate a start by `reversed`. Threads may share it as they may share `inner`.
template <class Real>
class ReversedSystem final : public System<Real> {
 public:
  /// Shares ownership of `inner`. Throws Misuse for one with switches, a discrete state or steps that ask for a mode.
  explicit ReversedSystem(std::shared_ptr<const System<Real>> inner)
      : inner_(std::move(inner)),
        sizes_(inner_->sizes()),
        velocities_(inner_->secondOrder() ? 0 : inner_->sceneSizes().nu),
        times_(inner_->times()) {
    for (Real& t : times_) t = opposite(t);
    std::reverse(times_.begin(), times_.end());
    if (inner_->completesSteps()) {
      throw Misuse(
          "t_end lies before the start, and steps of the system ask for modes (completeStep): the mode before "
          "does not follow from the state after it");
    }
    if (sizes_.switches == 0 && sizes_.discrete == 0) return;
    throw Misuse("t_end lies before the start, and the system has " + std::to_string(sizes_.switches) +
                 " switches and a discrete state of " + std::to_string(sizes_.discrete) +
                 " numbers: the mode before a switch does not follow from the state after it");
  }

  Sizes sizes() const override { return sizes_; }
  Sizes sceneSizes() const override { return inner_->sceneSizes(); }
  void evaluate(Level level, const Point<Real>& p, VecView<Real> r) const override { evaluateAt(level, p, r); }
  void evaluate(Level level, const Point<Dual<Real>>& p, VecView<Dual<Real>> r) const override {
    evaluateAt(level, p, r);
  }
  const std::vector<int>& rowPowers() const override { return inner_->rowPowers(); }
  const ErrorPowers& errorPowers() const override { return inner_->errorPowers(); }
  std::vector<Real> times() const override { return times_; }
  /// Throws Misuse if u, v or x jump: what they were before does not follow from what they are after it.
  void jumpAtTime(Index i, State<Real>& state) const override {
    const State<Real> before = turned(state);
    State<Real> after = before;
    const Index own = static_cast<Index>(times_.size()) - 1 - i;
    inner_->jumpAtTime(own, after);
    if (after.u == before.u && after.v == before.v && after.x == before.x) return;
    std::ostringstream text;
    text << "t_end lies before the start, and the state jumps at t = " << static_cast<double>(before.t) << ", time "
         << own << " (from 0 on) of the system: the state before a jump does not follow from the one after it";
    throw Misuse(text.str());
  }
  // nonNegative is false of all: what an exact solution never does forward, it may do backward.
  bool usesVelocity() const override { return inner_->usesVelocity(); }
  const std::vector<Index>& leftOut() const override { return inner_->leftOut(); }
  Discontinuity discontinuity() const override { return inner_->discontinuity(); }
  bool projectsVelocity() const override { return inner_->projectsVelocity(); }
  bool secondOrder() const override { return inner_->secondOrder(); }
  State<Real> fromScene(const State<Real>& scene) const override { return turned(inner_->fromScene(reversed(scene))); }
  State<Real> toScene(const State<Real>& state) const override { return reversed(inner_->toScene(turned(state))); }

 private:
  State<Real> turned(const State<Real>& state) const { return reversed(state, velocities_, velocities_); }

  template <class T>
  void evaluateAt(Level level, const Point<T>& p, VecView<T> r) const {
    const Index nu = sizes_.nu, nx = sizes_.nx;
    boost::container::small_vector<T, kFewNumbers> y;  // v, x, k of the inner system; few do not allocate
    y.reserve(static_cast<std::size_t>(nu + 2 * nx));
    const auto isVelocity = [this](Index i) { return i >= velocities_ && i < 2 * velocities_; };
    for (Index i = 0; i < nu; ++i) y.push_back(opposite(p.v[i]));
    for (Index i = 0; i < nx; ++i) y.push_back(isVelocity(i) ? opposite(p.x[i]) : p.x[i]);
    for (Index i = 0; i < nx; ++i) y.push_back(isVelocity(i) ? p.k[i] : opposite(p.k[i]));
    const T* const v = y.data();
    inner_->evaluate(level, {opposite(p.t), p.u, {v, nu}, {v + nu, nx}, p.a, {v + nu + nx, nx}, p.z, p.d}, r);
    if (level != Level::kVelocity) return;
    for (Index i = 0; i < sizes_.constraints; ++i) r[nu + nx + i] = opposite(r[nu + nx + i]);  // dg/dtau
  }

  static constexpr std::size_t kFewNumbers = 32;

  std::shared_ptr<const System<Real>> inner_;
  Sizes sizes_;
  Index velocities_;  // x = (u, v, ...): how many positions u it begins with, and then velocities v; 0: x has none
  std::vector<Real> times_;
};

}  // namespace irk
