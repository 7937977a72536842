// One step of the scheme: predict, solve, finish, and settle the discrete state.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "core/newton.h"
#include "core/predictor.h"
#include "core/projection.h"
#include "core/switches.h"

namespace irk {

struct StepResult {
  Outcome outcome = Outcome::kSuccess;
  int newton_iterations = 0;
  double theta = 0;     ///< Newton's contraction (see NewtonResult), the worst of the attempt's solves
  Index switched = -1;  ///< the last switch done at the step's end, or the one to blame
  /// Where in the step it became due, by linear interpolation, in (0, 1]; NaN without one.
  double switch_at = std::numeric_limits<double>::quiet_NaN();
  /// Of a step that ends in another mode than it began, in the error norm. `iterate`: the
  /// difference between the step in its first mode and in its last, what the wrong one of them does
  /// over the whole step. Else, with the estimate `richardson`: h times the defect of the stages'
  /// polynomial at the step's start.
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
  void iterateModes(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h,
                    State<Real>& to, StepResult& result);
  bool dueInside();
  double firstDue(const State<Real>& from, const State<Real>& to);
  void settle(const State<Real>& from, const Real& h, State<Real>& to, StepResult& result);

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
  Mat<Real> defect_;        // n x 1
  Vec<double> row_weights_;  // of the defect
  bool sees_switches_;
  Vec<double> ones_;
  Vec<Real> g_before_;
  std::vector<Index> done_;  // switches of the discontinuous iterations
};

}  // namespace irk
