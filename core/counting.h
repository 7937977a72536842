// Decorators that count: no strategy can forget it.
#pragma once

#include "core/statistics.h"
#include "core/system.h"

namespace irk {

/// Forwards to another system and counts its evaluations. One per integrator.
template <class Real>
class CountingSystem final : public System<Real> {
 public:
  CountingSystem(const System<Real>& inner, Counters& counters)
      : inner_(inner), counters_(counters) {}
  Sizes sizes() const override { return inner_.sizes(); }
  void evaluate(Level level, const Point<Real>& p, VecView<Real> r) const override {
    ++counters_.residuals;
    inner_.evaluate(level, p, r);
  }
  void evaluate(Level level, const Point<Dual<Real>>& p, VecView<Dual<Real>> r) const override {
    ++counters_.dual_residuals;
    inner_.evaluate(level, p, r);
  }
  const std::vector<int>& rowPowers() const override { return inner_.rowPowers(); }
  const ErrorPowers& errorPowers() const override { return inner_.errorPowers(); }
  void switching(const Point<Real>& p, VecView<Real> g) const override { inner_.switching(p, g); }
  void onSwitch(Index i, State<Real>& state) const override { inner_.onSwitch(i, state); }
  void jump(Index i, State<Real>& state) const override { inner_.jump(i, state); }
  std::string switchName(Index i) const override { return inner_.switchName(i); }
  Discontinuity discontinuity() const override { return inner_.discontinuity(); }
  bool projectsVelocity() const override { return inner_.projectsVelocity(); }
  bool secondOrder() const override { return inner_.secondOrder(); }
  State<Real> fromScene(const State<Real>& scene) const override {
    return inner_.fromScene(scene);
  }
  State<Real> toScene(const State<Real>& state) const override { return inner_.toScene(state); }

 private:
  const System<Real>& inner_;
  Counters& counters_;
};

}  // namespace irk
