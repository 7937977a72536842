// The form y' = f(t, y) that codes for ordinary differential equations need: y = (u, v, x),
// f = (v, a, k), where (a, k, z) solve the residual at acceleration level.
// Users call firstOrderForm in irk/problem.h.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/derivatives/differentiator.h"
#include "core/derivatives/rate_lu.h"
#include "core/system/reversed.h"
#include "irk/problem.h"

namespace irk {

/// A system in first-order form: its x is (u, v, x) of the inner system, its rows are f(t, x) - k. z is eliminated:
/// position constraints enter twice differentiated, so that positions drift. For a mechanism f contains
/// v' = M^-1 F: M (the whole D0) is evaluated and factorized at every new point or once per step, unless it is
/// constant. D0 is sparse where `automatic` storage is.
///
/// Unlike other systems it keeps scratch: use one object per thread.
template <class Real>
class FirstOrderForm final : public System<Real> {
 public:
  /// Shares ownership of `inner`, which is evaluated at acceleration level only.
  explicit FirstOrderForm(std::shared_ptr<const System<Real>> inner, MassFactors factors = MassFactors::kEachPoint);

  Sizes sizes() const override { return sizes_; }
  Sizes sceneSizes() const override { return inner_sizes_; }
  /// Ignores `level`, since there are no constraints left. Writes NaN where D0 is singular.
  void evaluate(Level level, const Point<Real>& p, VecView<Real> r) const override;
  /// Differentiates implicitly: D0 dw = -dr, where dr is taken at fixed w = (a, k, z).
  void evaluate(Level level, const Point<Dual<Real>>& p, VecView<Dual<Real>> r) const override;
  /// The points of one residual evaluation: with other times than those before, they are a new step.
  void evaluateStages(const StagePoints<Real>& at, Index first, Index last, Real* r) const override;
  const std::vector<int>& rowPowers() const override { return row_powers_; }
  const ErrorPowers& errorPowers() const override { return error_powers_; }
  void switching(const Point<Real>& p, VecView<Real> g) const override;
  void onSwitch(Index i, State<Real>& s) const override { switchBy("System::onSwitch", &Base::onSwitch, i, s); }
  void jump(Index i, State<Real>& s) const override { jumpBy("System::jump", &Base::jump, i, s); }
  std::vector<Real> times() const override { return inner_->times(); }
  void onTime(Index i, State<Real>& s) const override { switchBy("System::onTime", &Base::onTime, i, s); }
  void jumpAtTime(Index i, State<Real>& s) const override { jumpBy("System::jumpAtTime", &Base::jumpAtTime, i, s); }
  bool completesSteps() const override { return inner_->completesSteps(); }
  bool completeStep(State<Real>& state) const override;
  bool nonNegative(Index i) const override { return inner_->nonNegative(i); }
  std::string switchName(Index i) const override { return inner_->switchName(i); }
  Discontinuity discontinuity() const override { return inner_->discontinuity(); }
  bool secondOrder() const override { return false; }

  /// Throws Misuse if D0 is singular at `scene`: (a, k, z) then do not follow from (u, v, x).
  State<Real> fromScene(const State<Real>& scene) const override;
  State<Real> toScene(const State<Real>& state) const override;

  /// Its states are those of toScene; its constraints hold for the positions of y as well.
  const System<Real>& inner() const { return *inner_; }
  /// The first-order form of the inner system over -t. Throws Misuse as ReversedSystem.
  std::shared_ptr<const System<Real>> backward() const {
    return std::make_shared<const FirstOrderForm>(std::make_shared<const ReversedSystem<Real>>(inner_), factors_);
  }
  /// Factorizations of D0 since the last fromScene.
  std::int64_t massFactorizations() const { return factorizations_; }

 private:
  /// How D0 depends on the point; decides how often it is evaluated. kDiagonal is also constant; kLinear: it depends
  /// on (t, u, v, x), but not on (a, k, z).
  enum class Rates { kDiagonal, kConstant, kLinear, kNonlinear };
  /// Those with which w is found: of another point, or of each iterate.
  enum class Factors { kKept, kRenewed };

  using Base = System<Real>;
  using Change = void (Base::*)(Index, State<Real>&) const;
  void switchBy(const char* name, Change change, Index i, State<Real>& state) const;
  void jumpBy(const char* name, Change change, Index i, State<Real>& state) const;

  bool classify(const State<Real>& scene) const;  // false: D0 is singular
  void takeMode(const char* function, const State<Real>& scene, State<Real>& state) const;
  Rates kindNear(const State<Real>& scene, const Vec<Real>& D0) const;
  bool isRegular() const;
  bool isDiagonal() const;
  bool solve(const Real& t, const Real* y, const Real* d) const;
  bool holds(const Real& t, const Real* y, const Real* d) const;
  bool solveLinear() const;
  bool iterate(Factors factors) const;
  bool isSolution(const Vec<Real>& residual) const;
  void forgetPattern() const;
  void evaluateMatrix() const;
  void evaluateColumns() const;
  bool factorize() const;
  void divideByMatrix(Vec<Real>& x) const;

  std::shared_ptr<const System<Real>> inner_;
  Sizes inner_sizes_, sizes_;
  std::vector<int> row_powers_;
  ErrorPowers error_powers_;

  MassFactors factors_;
  mutable bool renew_ = true;                // the next solve factorizes
  mutable bool renewed_ = false;             // by a Jacobian, at the start of the step that follows
  mutable Real first_time_{}, last_time_{};  // of the last stages
  mutable Rates rates_ = Rates::kNonlinear;
  mutable bool solved_ = false;
  mutable State<Real> at_;     // the last point, with its solution w
  mutable Vec<Real> start_w_;  // Newton's start values after a failure
  mutable Vec<Real> residual_, column_, values_;
  mutable State<Dual<Real>> dual_;
  mutable Vec<Dual<Real>> dual_residual_;
  mutable Vec<Real> diagonal_;                            // of D0, used for kDiagonal
  mutable std::unique_ptr<Differentiator<Real>> sparse_;  // evaluates D0; null for few unknowns or a dense D0
  mutable Linearization<Real> D_;                         // D0
  mutable RateLu<Real> lu_;
  mutable std::int64_t factorizations_ = 0;
};

/// Those of a system that is a first-order form, part of Counters::mass_factorizations; 0 of any other.
template <class Real>
std::int64_t massFactorizations(const System<Real>& system) {
  const auto* form = dynamic_cast<const FirstOrderForm<Real>*>(&system);
  return form ? form->massFactorizations() : 0;
}

}  // namespace irk
