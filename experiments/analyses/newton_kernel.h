// The parts of an integration alone, at one state of a scene: for timing each of them.
#pragma once

#include <memory>
#include <vector>

#include "core/control/controller.h"
#include "core/stage_solvers/stage_solver.h"
#include "core/stages/error_norm.h"
#include "core/stages/stage_equations.h"
#include "core/stages/start_values.h"
#include "core/system/counting.h"
#include "core/system/switches.h"
#include "experiments/runs/setup.h"

namespace irk {

class NewtonKernel {
 public:
  /// `h`: the step that the Newton matrix is made for. Throws Misuse as `prepare`.
  NewtonKernel(const RunSpec& spec, double h);
  /// The parts at another state, in the scene's unknowns: a residual at the start may cost less than in
  /// motion (sin 0 takes a fifth of the time of another sine).
  void moveTo(const State<double>& scene_state);

  Index unknowns() const { return rhs_.rows(); }  ///< n, of one stage
  Index nonzeros() const { return at_.front().pattern->nonzeros(); }  ///< of D0, D1, D2 together
  std::size_t directions() const { return differentiator_.directions(); }  ///< of a Jacobian
  Index stages() const { return scheme_.implicitStages(); }  ///< that are solved for

  void residuals();      ///< r of all stages, in one call as in an iteration
  void jacobian();       ///< D0, D1, D2 at one point
  /// What every integration does once: the pattern of D0, D1, D2 and they themselves; where it is sparse,
  /// its analysis and, for every stepper, a new solver with its first factors.
  void firstMatrices();
  void factorize();      ///< the Newton matrix of all stages. Throws Misuse if it is singular
  void solve();          ///< with its factors, which must be there
  void iteration();      ///< residuals of all stages and a solve
  /// What is left of an iteration: the stages' u, v, x, row scaling, the increment, its norm and what
  /// Newton's test computes from it.
  void update();
  /// What is left of an attempted step: weights, start values, the step's end, switches, the error's norm
  /// and the next step's size; with step doubling of the whole step and of both halves.
  void step();

  /// Evaluations of r, over the plain scalar, in one `jacobian` and in `firstMatrices`.
  std::int64_t residualsPerJacobian() const { return residuals_per_jacobian_; }
  std::int64_t residualsOfFirst() const { return residuals_of_first_; }
  bool sparse() const { return !at_.front().pattern->full; }
  std::int64_t steppers() const { return doubles_ ? 2 : 1; }  ///< of an attempt

 private:
  NewtonKernel(const Setup<double>& setup, const RunSpec& spec, double h);
  Point<double> point() const { return pointOf(start_); }
  void countResiduals(const RunSpec& spec);
  void begin();
  void makeSolver();
  void solvedStep(StartValues<double>& start_values, const StagePolynomial<double>& past,
                  const State<double>& from, double h, State<double>& end);

  std::shared_ptr<const System<double>> system_;
  std::unique_ptr<const System<double>> free_;  // the same with r = 0
  Counters counters_;
  CountingSystem<double> counted_;  // as an integrator sees the system
  State<double> start_;
  double h_;
  Differentiator<double> differentiator_;
  std::vector<Linearization<double>> at_;
  Scheme<double> scheme_;
  StageEquations<double> equations_, free_equations_;
  StageSolverKind kind_;
  StageSolverSetup<double> setup_;
  std::unique_ptr<StageSolver<double>> solver_;
  ErrorNorm<double> norm_;
  Switches<double> switches_;
  std::unique_ptr<StepController> controller_;
  bool doubles_;  // the step
  StartValues<double> whole_start_, half_start_;
  StagePolynomial<double> before_, solved_;  // the step before, and this one
  State<double> middle_, coarse_, fine_;
  Vec<double> row_weights_, factor_, t_;
  Mat<double> U_, V_, X_;  // of all stages
  volatile double decided_ = 0;  // keeps what is computed and not used
  Mat<double> ones_, rhs_, W_, W0_, R_;
  std::int64_t residuals_per_jacobian_ = 0, residuals_of_first_ = 0;
};

}  // namespace irk
