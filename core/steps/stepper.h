// One step of the scheme: predict, solve, finish, and settle the discrete state.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "core/derivatives/consistent_start.h"
#include "core/derivatives/projection.h"
#include "core/newton/newton.h"
#include "core/stages/start_values.h"
#include "core/steps/switch_scan.h"

namespace irk {

struct StepResult {
  Outcome outcome = Outcome::kSuccess;
  int newton_iterations = 0;
  double theta = 0;     ///< Newton's contraction (see NewtonResult), the worst of the attempt's solves
  double round_off = 0;  ///< of Newton's increments, in tolerances (see NewtonResult)
  Index switched = -1;  ///< the last switch done at the step's end, or the one to blame
  /// Where in the step it became due, by linear interpolation, in (0, 1]; NaN without one.
  double switch_at = std::numeric_limits<double>::quiet_NaN();
  /// Of a step in which a switch becomes due, in the error norm: what the wrong mode does over the
  /// whole step. `iterate`: the difference between the step in its first mode and in its last; where
  /// the switch comes and goes inside the step, h times the change of (a, k) that it makes. `ignore`
  /// and `smooth` with an estimate that sees switches: h times the largest change of (a, k) in the step.
  double mode_error = 0;
};

/// Attempts steps; keeps the stages of its last solved step. Owns all scratch of a step. A failed
/// attempt leaves `to` and the stage polynomial unspecified but `from` untouched.
template <class Real>
class Stepper {
 public:
  Stepper(const System<Real>& system, const Scheme<Real>& scheme, const IntegratorOptions& options,
          SharedJacobian<Real>& jacobian, const ErrorNorm<Real>& norm, Counters& counters);

  /// One step [from.t, from.t + h] with start values from `past` (may be this stepper's own).
  [[nodiscard]] StepResult attempt(const StagePolynomial<Real>& past, const State<Real>& from,
                                   const Real& h, State<Real>& to,
                                   JacobianUse use = JacobianUse::kRefreshIfStale);

  /// Of the step solved last, after a restart from a known `from.w`, in the error norm: h times the
  /// difference between (a, k) at the start and the stages' polynomial there; 0 where that follows
  /// the motion. L-stable methods damp a fast motion that starts at a switch, in the whole step and in
  /// its halves alike, and no other estimate sees it.
  double startDefect(const State<Real>& from);

  /// Whether the step solved last may be on another root of the stage equations: algebraic unknowns of
  /// index 2 have round-off over h, and at tiny steps Newton can go from one root to another; (a, k) then
  /// do not continue those of `from`. Always false where (a, k) follow from (u, v, x).
  bool leavesRoot(const State<Real>& from);

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
  void solve(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h,
             State<Real>& to, JacobianUse use, StepResult& result);
  void takeStages(const State<Real>& from, const Real& h);
  void iterateModes(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h,
                    State<Real>& to, StepResult& result);
  void followModes(const State<Real>& from, const Real& h, State<Real>& to, StepResult& result);
  double firstDue(const State<Real>& from, const State<Real>& to);
  bool dueInside(const State<Real>& from, const State<Real>& to, Index& index);
  double modeChange(const Real& h);
  double largestChange(const State<Real>& from, const Real& h);
  double changeInStep(const State<Real>& from, const Real& h, const State<Real>& to);
  double stepNorm(const Vec<Real>& dw, const Real& h);
  int highest() const { return W_.cols() > 2 ? 2 : 1; }  // coefficients of `roughness`

  const System<Real>& system_;
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
  Switches<Real> switches_;
  State<Real> frozen_;      // `iterate`: the start with another discrete state
  State<Real> first_mode_;  // and the end in the first one
  std::unique_ptr<SwitchScan<Real>> scan_;             // but in `locate`
  std::unique_ptr<ConsistentStart<Real>> consistent_;  // (a, k) of another mode
  State<Real> other_mode_;
  Vec<Real> rates_;  // n
  Vec<double> row_weights_;
  bool sees_switches_;
  bool has_hidden_unknowns_;  // algebraic, of index 2, and no multipliers of position constraints
  Vec<double> ones_;
  Vec<Real> g_before_;
  std::vector<Index> done_;  // switches of the discontinuous iterations
};

}  // namespace irk
