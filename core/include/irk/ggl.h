// The stabilised index-2 formulation of Gear, Gupta & Leimkuhler, J. CAM 12-13 (1985); HW II
// (VII.1):
//   u' = v + G^T mu,   M v' = f - G^T lambda,   0 = g(t, u),   0 = dg/dt,   G = dg/du.
#pragma once

#include "irk/problem_system.h"

namespace irk {

/// A problem struct P with position constraints as a system of first order. Its unknowns are x = (u, v, x of the scene)
/// and z = (z of the scene, mu); it has no second-order rows. Immutable. The constructor throws Misuse for the same
/// reasons as that of ProblemSystem.
template <class P, class Real>
class GglSystem final : public System<Real> {
 public:
  GglSystem(P problem, const SystemOptions& options, const std::vector<Real>& kinks = {})
      : scene_(std::move(problem), options, kinks), inner_(scene_.sizes()) {
    sizes_ = inner_;
    sizes_.nu = 0;
    sizes_.nx = 2 * inner_.nu + inner_.nx;
    sizes_.nz = inner_.nz + inner_.constraints;
    row_powers_ = scene_.rowPowers();
    row_powers_.insert(row_powers_.begin(), static_cast<std::size_t>(inner_.nu), 0);
    const int power = options.scaling == ConstraintScaling::kOn ? 1 : 0;
    row_powers_.insert(row_powers_.end(), static_cast<std::size_t>(inner_.constraints), power);
    error_powers_.x.assign(static_cast<std::size_t>(sizes_.nx), 0);
    error_powers_.z = scene_.errorPowers().z;
    error_powers_.z.insert(error_powers_.z.end(), static_cast<std::size_t>(inner_.constraints), 1);
    for (const Index i : leftOut()) {
      row_powers_[static_cast<std::size_t>(inner_.nu + inner_.n() + i)] = 0;
      error_powers_.z[static_cast<std::size_t>(inner_.nz + i)] = 0;
    }
  }

  Sizes sizes() const override { return sizes_; }
  Sizes sceneSizes() const override { return inner_; }
  void evaluate(Level level, const Point<Real>& p, VecView<Real> r) const override { evaluateAt(level, p, r.data()); }
  void evaluate(Level level, const Point<Dual<Real>>& p, VecView<Dual<Real>> r) const override {
    evaluateAt(level, p, r.data());
  }
  void switching(const Point<Real>& p, VecView<Real> g) const override { scene_.switching(scenePoint(p), g); }
  void onSwitch(Index i, State<Real>& state) const override { changeBy(&Base::onSwitch, i, state); }
  void jump(Index i, State<Real>& state) const override { changeBy(&Base::jump, i, state); }
  std::vector<Real> times() const override { return scene_.times(); }
  void onTime(Index i, State<Real>& state) const override { changeBy(&Base::onTime, i, state); }
  void jumpAtTime(Index i, State<Real>& state) const override { changeBy(&Base::jumpAtTime, i, state); }
  bool completesSteps() const override { return scene_.completesSteps(); }
  bool completeStep(State<Real>& state) const override {
    State<Real> scene = toScene(state);
    if (!scene_.completeStep(scene)) return false;
    state.d = scene.d;
    state.x << scene.u, scene.v, scene.x;
    return true;
  }
  bool nonNegative(Index i) const override { return scene_.nonNegative(i); }
  std::string switchName(Index i) const override { return scene_.switchName(i); }
  const std::vector<Index>& leftOut() const override { return scene_.leftOut(); }
  Discontinuity discontinuity() const override { return scene_.discontinuity(); }
  bool secondOrder() const override { return false; }
  const std::vector<int>& rowPowers() const override { return row_powers_; }
  const ErrorPowers& errorPowers() const override { return error_powers_; }

  State<Real> fromScene(const State<Real>& scene) const override {
    State<Real> state(sizes_);
    state.t = scene.t;
    state.d = scene.d;
    state.x << scene.u, scene.v, scene.x;
    state.w << scene.v, scene.w, Vec<Real>::Zero(inner_.constraints);
    return state;
  }
  State<Real> toScene(const State<Real>& state) const override {
    State<Real> scene(inner_);
    scene.t = state.t;
    scene.d = state.d;
    scene.u = state.x.head(inner_.nu);
    scene.v = state.x.segment(inner_.nu, inner_.nu);
    scene.x = state.x.tail(inner_.nx);
    scene.w = state.w.segment(inner_.nu, inner_.n());
    return scene;
  }

 private:
  using Base = System<Real>;
  void changeBy(void (Base::*change)(Index, State<Real>&) const, Index i, State<Real>& state) const {
    State<Real> scene = toScene(state);
    (scene_.*change)(i, scene);
    state.d = scene.d;
    state.x << scene.u, scene.v, scene.x;
  }

  template <class T>
  Point<T> scenePoint(const Point<T>& p) const {
    const Index nu = inner_.nu, nx = inner_.nx;
    return {p.t,
            {p.x.data(), nu},
            {p.x.data() + nu, nu},
            {p.x.data() + 2 * nu, nx},
            {p.k.data() + nu, nu},
            {p.k.data() + 2 * nu, nx},
            {p.z.data(), inner_.nz},
            p.d};
  }

  template <class T>
  void evaluateAt(Level level, const Point<T>& p, T* r) const {
    const Index nu = inner_.nu, nc = inner_.constraints;
    const Point<T> at = scenePoint(p);
    scene_.evaluateAt(level == Level::kFormulated ? Level::kPosition : level, at, r + nu);
    const ConstVec<T> mu(p.z.data() + inner_.nz, nc);
    for (Index i = 0; i < nu; ++i) r[i] = at.v[i] - p.k[i];
    for (Index first = 0; first < nu; first += static_cast<Index>(kChunk)) {
      const Index count = std::min(static_cast<Index>(kChunk), nu - first);
      scene_.problem().constraints(Dual<T>(p.t), detail::DirectionView<T>{at.u, first},
                                   detail::TransposedSink<T>{r + first, count, mu});
    }
    T* const last = r + nu + inner_.n();
    if (level == Level::kFormulated) {
      scene_.constraintRows(Level::kVelocity, at, last);
      scene_.leaveOut(at.z, r + nu + inner_.nu + inner_.nx);
      scene_.leaveOut(mu, last);
    } else {  // mu = 0 on the exact solution
      for (Index i = 0; i < nc; ++i) last[i] = mu[i];
    }
  }

  ProblemSystem<P, Real> scene_;
  Sizes inner_, sizes_;
  std::vector<int> row_powers_;
  ErrorPowers error_powers_;
};

}  // namespace irk
