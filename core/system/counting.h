// A decorator that counts evaluations, so that no strategy has to count its own, and checks the states that the system
// makes or changes.
#pragma once

#include <atomic>

#include "irk/statistics.h"
#include "irk/system.h"
#include "irk/system_check.h"

namespace irk {

/// Forwards to another system and counts its evaluations. Throws Misuse for states of other sizes than the system's:
/// they would be read beyond their ends. Keeps references to both. Each integrator has its own; several threads may
/// evaluate it at a time if `threads` > 1.
template <class Real>
class CountingSystem final : public System<Real> {
 public:
  CountingSystem(const System<Real>& inner, Counters& counters, int threads = 1)
      : inner_(inner), counters_(counters), threads_(threads) {}
  const System<Real>& inner() const { return inner_; }
  Sizes sizes() const override { return inner_.sizes(); }
  Sizes sceneSizes() const override { return inner_.sceneSizes(); }
  void evaluate(Level level, const Point<Real>& p, VecView<Real> r) const override {
    count(counters_.residuals);
    inner_.evaluate(level, p, r);
  }
  void evaluate(Level level, const Point<Dual<Real>>& p, VecView<Dual<Real>> r) const override {
    count(counters_.dual_residuals);
    inner_.evaluate(level, p, r);
  }
  void evaluatePoints(const StagePoints<Real>& at, Index first, Index last, Real* r) const override {
    count(counters_.residuals, last - first);
    inner_.evaluatePoints(at, first, last, r);
  }
  void evaluateStages(const StagePoints<Real>& at, Index first, Index last, Real* r) const override {
    count(counters_.residuals, last - first);
    inner_.evaluateStages(at, first, last, r);
  }
  const std::vector<int>& rowPowers() const override { return inner_.rowPowers(); }
  const ErrorPowers& errorPowers() const override { return inner_.errorPowers(); }
  void switching(const Point<Real>& p, VecView<Real> g) const override { inner_.switching(p, g); }
  void onSwitch(Index i, State<Real>& state) const override {
    inner_.onSwitch(i, state);
    requireState("System::onSwitch", state, sizes());
  }
  void jump(Index i, State<Real>& state) const override {
    inner_.jump(i, state);
    requireState("System::jump", state, sizes());
  }
  std::vector<Real> times() const override { return inner_.times(); }
  void onTime(Index i, State<Real>& state) const override {
    inner_.onTime(i, state);
    requireState("System::onTime", state, sizes());
  }
  void jumpAtTime(Index i, State<Real>& state) const override {
    inner_.jumpAtTime(i, state);
    requireState("System::jumpAtTime", state, sizes());
  }
  bool completesSteps() const override { return inner_.completesSteps(); }
  bool completeStep(State<Real>& state) const override {
    const bool asked = inner_.completeStep(state);
    requireState("System::completeStep", state, sizes());
    return asked;
  }
  bool nonNegative(Index i) const override { return inner_.nonNegative(i); }
  bool usesVelocity() const override { return inner_.usesVelocity(); }
  std::string switchName(Index i) const override { return inner_.switchName(i); }
  const std::vector<Index>& leftOut() const override { return inner_.leftOut(); }
  Discontinuity discontinuity() const override { return inner_.discontinuity(); }
  bool projectsVelocity() const override { return inner_.projectsVelocity(); }
  bool secondOrder() const override { return inner_.secondOrder(); }
  State<Real> fromScene(const State<Real>& scene) const override {
    State<Real> state = inner_.fromScene(scene);
    requireState("System::fromScene", state, sizes());
    return state;
  }
  State<Real> toScene(const State<Real>& state) const override {
    State<Real> scene = inner_.toScene(state);
    requireState("System::toScene", scene, sceneSizes());
    return scene;
  }

 private:
  void count(std::int64_t& counter, std::int64_t by = 1) const {
    if (threads_ == 1) {
      counter += by;
    } else {
      std::atomic_ref(counter).fetch_add(by, std::memory_order_relaxed);
    }
  }

  const System<Real>& inner_;
  Counters& counters_;
  int threads_;
};

/// The system inside `system` if that is a CountingSystem, else `system` itself.
template <class Real>
const System<Real>& uncounted(const System<Real>& system) {
  const auto* counting = dynamic_cast<const CountingSystem<Real>*>(&system);
  return counting ? uncounted(counting->inner()) : system;
}

}  // namespace irk
