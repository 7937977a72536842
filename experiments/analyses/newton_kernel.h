// The parts of an integration at one state of a scene, for timing each of them alone.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/control/controller.h"
#include "core/estimates/step_attempt.h"
#include "core/stage_solvers/stage_solver.h"
#include "core/stages/error_norm.h"
#include "core/stages/stage_equations.h"
#include "core/system/counting.h"
#include "experiments/runs/setup.h"

namespace irk {

class NewtonKernel {
 public:
  /// `h` is the step for the Newton matrix. Throws Misuse as `prepare`.
  NewtonKernel(const RunSpec& spec, double h);
  /// Moves to another state, given in the scene's unknowns. The residual can cost less at the start than in motion:
  /// sin 0 takes a fifth of the time of other sines.
  void moveTo(const State<double>& scene_state);

  Index unknowns() const { return rhs_.rows(); }             ///< of one stage
  Index stages() const { return scheme_.implicitStages(); }  ///< stages with unknowns

  void residuals();  ///< r at all stages, in one call as in an iteration
  void jacobian();   ///< D0, D1, D2 at one point
  /// The work done once per integration: finding the pattern of D0, D1, D2 and evaluating them; if they are sparse,
  /// also their analysis and, for every stepper, a new solver with its first factorization.
  void firstMatrices();
  void factorize();  ///< the Newton matrix of all stages. Throws Misuse if it is singular
  void solve();      ///< requires `factorize` before
  /// One iteration, always the same one: the residuals of all stages, a solve, and `update`, each with the result of
  /// the one before. It takes longer than the sum of its parts timed alone, because there the processor begins a call
  /// before the last one has ended.
  void iteration();
  /// One factorization of the filter of error estimates, a system of n unknowns. Throws Misuse if it is singular.
  void factorizeFilter();
  void solveFilter();  ///< requires `factorizeFilter` before
  /// The rest of an iteration: the stages' u, v, x, row scaling, the increment and its norm. The few operations of
  /// Newton's test are left out: they are part of `attempts`.
  void update();
  /// Two attempted steps in a row, always the same ones, with the integrator's own error estimate and all other parts
  /// of a step but the step control and new Jacobians. Returns their counts. Steps that fail are halved; nothing is
  /// returned if that does not help.
  std::optional<Counters> attempts();
  /// The rest of an attempted step: the weights of the error norm, and the step control.
  void step();

  /// Evaluations of r, over the plain scalar, in one call of `jacobian` and of `firstMatrices`.
  std::int64_t residualsPerJacobian() const { return residuals_per_jacobian_; }
  std::int64_t residualsOfFirst() const { return residuals_of_first_; }
  bool sparse() const { return !at_.front().pattern->full; }
  std::int64_t steppers() const { return doubles_ ? 2 : 1; }  ///< used by one attempt

 private:
  NewtonKernel(const Setup<double>& setup, const RunSpec& spec, double h);
  Point<double> point() const { return pointOf(start_); }
  void countResiduals(const RunSpec& spec);
  void begin();
  void makeSolver();
  void moveBy(const Mat<double>& increment);

  std::shared_ptr<const System<double>> system_;
  std::unique_ptr<const System<double>> free_;  // the same system with r = 0
  Counters counters_;
  CountingSystem<double> counted_;  // counts evaluations, as in an integrator
  State<double> start_;
  double h_, solvable_h_;  // solvable_h_, or less, is the step of `attempts`
  Differentiator<double> differentiator_;
  std::vector<Linearization<double>> at_;
  SchemeList<double> schemes_;
  const Scheme<double>& scheme_;
  IntegratorOptions options_;
  StageEquations<double> equations_, free_equations_;
  StageSolverKind kind_;
  StageSolverSetup<double> setup_, filter_setup_;
  std::unique_ptr<CountedStageSolver<double>> solver_, filter_;
  ErrorNorm<double> norm_;
  std::unique_ptr<StepController> controller_;
  bool doubles_;  // whether the estimate is by step doubling
  SharedJacobian<double> shared_;
  std::unique_ptr<StepAttempt<double>> attempt_;
  State<double> middle_, end_;
  Vec<double> row_weights_, t_;
  Mat<double> U_, V_, X_;        // at all stages
  volatile double decided_ = 0;  // keeps the compiler from removing unused results
  Mat<double> ones_, rhs_, one_rhs_, W_, W0_, R_;
  std::int64_t residuals_per_jacobian_ = 0, residuals_of_first_ = 0;
};

}  // namespace irk
