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

  /// One step [from.t, from.t + h] with start values from `past` (may be this stepper's own).
  [[nodiscard]] StepResult attempt(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h,
                                   State<Real>& to, JacobianUse use = JacobianUse::kRefreshIfStale);

  /// Of the step solved last, after a restart from a known `from.w`, in the error norm: h times the
  /// difference between (a, k) at the start and the stages' polynomial there; 0 where that follows
  /// the motion. L-stable methods damp a fast motion that starts at a switch, in the whole step and in
  /// its halves alike, and no other estimate sees it.
  double startDefect(const State<Real>& from);

  /// Whether the step solved last may be on another root of the stage equations: algebraic unknowns of
  /// index 2 have round-off over h, and at tiny steps Newton can go from one root to another; (a, k) then
  /// do not continue those of `from`. Always false where (a, k) follow from (u, v, x).
  bool leavesRoot(const State<Real>& from);

  /// Whether (a, k) of the step solved last are rates that later steps can be compared with: where index 2 hides them,
  /// those of a step that moves the solution by less than a tolerance may be an error of its start, divided by h.
  bool tellsRates();

  /// Of the step solved last, in the error norm: h times the highest Legendre coefficients of (a, k) in
  /// the stages' polynomial and, of stiffly accurate methods, what it misses of (a, k) at the start. They
  /// fall with h^decay() where the step resolves the motion.
  double roughness(const State<Real>& from);
  int decay() const;

  /// Allocates what the first attempt would, where the pattern is known.
  void reserve() { matrix_.reserve(); }
  const StagePolynomial<Real>& stages() const { return stages_; }
  /// Its factors, for what else is solved with the same Jacobian and step.
  NewtonMatrix<Real>& matrix() { return matrix_; }
  /// Forget the solved step: after a failure of Newton or a discontinuity it predicts badly.
  void forget() {
    stages_.valid = false;
    newton_->forget();
  }

 private:
  void solve(const State<Real>& from, const Real& h, JacobianUse use, StepResult& result);
  void solveAndKeep(const State<Real>& from, const Real& h, JacobianUse use, StepResult& result);
  void repeat(const State<Real>& start, StepResult& result) override;
  int highest() const { return W_.cols() > 2 ? 2 : 1; }  // coefficients of `roughness`

  Sizes sizes_;
  Counters& counters_;
  StageEquations<Real> eq_;
  NewtonMatrix<Real> matrix_;
  StagewiseMatrix<Real> stagewise_;
  std::unique_ptr<Newton<Real>> newton_;
  const ErrorNorm<Real>& norm_;
  StartValues<Real> start_values_;
  StagePolynomial<Real> stages_;
  Mat<Real> W_;
  std::unique_ptr<VelocityProjection<Real>> projection_;
  std::unique_ptr<ModesInStep<Real>> modes_;  // null where nothing follows a solved step
  RateNorm<Real> rate_norm_;
  Vec<Real> rates_;           // n
  bool has_hidden_unknowns_;  // algebraic, of index 2, and no multipliers of position constraints
  // Of the attempt, for `repeat`.
  const StagePolynomial<Real>* past_ = nullptr;
  State<Real>* to_ = nullptr;
};

}  // namespace irk
