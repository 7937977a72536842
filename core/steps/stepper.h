// One step of the scheme: predict, solve, finish, and settle the mode.
#pragma once

#include <memory>

#include "core/derivatives/projection.h"
#include "core/newton/newton.h"
#include "core/stages/start_values.h"
#include "core/steps/modes.h"
#include "core/steps/rate_norm.h"

namespace irk {

/// Attempts steps; keeps the stages of its last solved step. Owns all scratch of a step. A failed
/// attempt leaves `to` and the stage polynomial unspecified but `from` untouched.
template <class Real>
class Stepper final : private StepRepeater<Real> {
 public:
  Stepper(const System<Real>& system, const Scheme<Real>& scheme, const IntegratorOptions& options,
          SharedJacobian<Real>& jacobian, const ErrorNorm<Real>& norm, Counters& counters);

  /// Attempts the step [from.t, from.t + h] with start values from `past`, which may be this stepper's own stages.
  [[nodiscard]] StepResult attempt(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h,
                                   State<Real>& to, JacobianUse use = JacobianUse::kRefreshIfStale);

  /// For the step solved last, after a restart from a known `from.w`: the norm of h times the difference between (a, k)
  /// at the start and the stages' polynomial there; 0 if the polynomial follows the motion, and where index 2 hides the
  /// rates. L-stable methods damp a fast motion that starts at a switch, in the whole step and in its halves alike, and
  /// so does the filter of the defect: no other estimate is sure to show it.
  double startDefect(const State<Real>& from);

  /// For the step solved last, in the error norm: h times the two highest Legendre coefficients (the highest one up to
  /// two stages) of (a, k) in the stages' polynomial. It falls with h^decay() where the step resolves the motion, and
  /// is then above what the polynomial misses.
  double roughness();
  int decay() const;

  /// Allocates in advance what the first attempt would, if the pattern is known.
  void reserve() { matrix_.reserve(); }
  const StagePolynomial<Real>& stages() const { return stages_; }
  /// The stepper's Newton matrix, for other systems with the same Jacobian and step size.
  NewtonMatrix<Real>& matrix() { return matrix_; }
  /// Forgets the solved step, which is a bad prediction after a failure of Newton's method or a discontinuity.
  void forget() {
    stages_.valid = false;
    newton_->forget();
  }

 private:
  void solve(const State<Real>& from, const Real& h, JacobianUse use, StepResult& result);
  void solveAndKeep(const State<Real>& from, const Real& h, JacobianUse use, StepResult& result);
  void repeat(const State<Real>& start, StepResult& result) override;
  int highest() const { return W_.cols() > 2 ? 2 : 1; }  // number of coefficients in `roughness`

  Counters& counters_;
  int threads_;
  StageEquations<Real> eq_;
  NewtonMatrix<Real> matrix_;
  std::unique_ptr<StagewiseMatrix<Real>> stagewise_;  // null: the Newton method does not use it
  std::unique_ptr<Newton<Real>> newton_;
  const ErrorNorm<Real>& norm_;
  StartValues<Real> start_values_;
  StagePolynomial<Real> stages_;
  Mat<Real> W_;
  std::unique_ptr<VelocityProjection<Real>> projection_;
  std::unique_ptr<ModesInStep<Real>> modes_;  // null: no treatment after a solved step
  RateNorm<Real> rate_norm_;
  Vec<Real> rates_;           // n
  bool has_hidden_unknowns_;  // algebraic, of index 2, and no multipliers of position constraints
  // Arguments of the attempt, for `repeat`.
  const StagePolynomial<Real>* past_ = nullptr;
  State<Real>* to_ = nullptr;
};

}  // namespace irk
