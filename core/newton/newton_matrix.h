// D0, D1, D2 at one point, kept over steps; and Newton matrices built on them.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "core/linear/sparse_lu.h"
#include "core/stage_solvers/stage_solver.h"
#include "core/stages/stage_equations.h"

namespace irk {

/// The linearization that all solves of a step share, with its age: one for all stages or, at `each_stage`, one per
/// stage. One object per integrator.
template <class Real>
class SharedJacobian {
 public:
  SharedJacobian(const System<Real>& system, const Scheme<Real>& scheme, const IntegratorOptions& options,
                 Counters& counters);

  /// Evaluates at the start or middle of the step that `eq` has begun, or at one or all of its stages W.
  void evaluate(StageEquations<Real>& eq, const Mat<Real>& W);
  /// Forgets the linearization; for a new mode.
  void forget();
  /// Forgets the pattern as well; for a new integration.
  void forgetPattern();
  /// Asks for a new evaluation at the next step's start.
  void markStale() { stale_ = true; }
  bool stale() const { return stale_; }
  /// Whether the last evaluation was for a step that began at t.
  bool evaluatedAt(const Real& t) const { return version_ > 0 && t_ == t; }

  std::span<const Linearization<Real>> at() const { return at_; }
  /// The cost of factors for another step size, in steps; call it after `evaluate`. Dense factors cost n^3, the solves
  /// of a step n^2. The result is 0 for sparse factors: they cost little, and keeping step sizes for longer made
  /// nothing faster (six scenes).
  double factorsCost() const {
    constexpr double kDenseUnknowns = 40;
    const auto& pattern = at_.front().pattern;  // null where each stage has its own matrices
    return pattern && pattern->full ? static_cast<double>(pattern->n) / kDenseUnknowns : 0;
  }
  /// The contraction up to which the Jacobian is kept for the next step: that of the options, but unless this is 0 at
  /// least 0.1 where new factors cost a step or more. RADAU5: "Increase THET, to 0.1 say, when Jacobian evaluations are
  /// costly." With 200 unknowns: 0.37 to 0.90 of the time at 1e-7 to 1e-2, with 40: 0.55 to 1.0.
  double keepBelow(double option) const {
    constexpr double kOfCostlyOnes = 0.1;
    return option > 0 && factorsCost() >= 1 ? std::max(option, kOfCostlyOnes) : option;
  }
  int version() const { return version_; }
  Differentiator<Real>& differentiator() { return differentiator_; }
  /// The symbolic analysis of a pattern, shared by all that factorize matrices of one stage; null for a dense one.
  const std::shared_ptr<const SparseAnalysis>& analysis(const std::shared_ptr<const Pattern>& pattern);

 private:
  Differentiator<Real> differentiator_;
  std::vector<Linearization<Real>> at_;
  JacobianPoint point_;
  State<Real> middle_;  // of the step, where that is the point
  Counters& counters_;
  Real t_{};
  int version_ = 0;
  bool stale_ = true;
  std::shared_ptr<const Pattern> analysed_;
  std::shared_ptr<const SparseAnalysis> analysis_;  // of analysed_
};

/// A factorization for one step size; renewed when the shared Jacobian or h has changed. Its solver is made when the
/// pattern is known.
template <class Real>
class NewtonMatrix {
 public:
  /// The setup has no pattern. Throws Misuse for `eigen` with a defective A.
  NewtonMatrix(SharedJacobian<Real>& shared, StageSolverKind kind, StageSolverSetup<Real> setup, Counters& counters,
               SolverOf of = SolverOf::kStages);

  /// Factorizes for step h with the shared Jacobian, unless these factors exist.
  [[nodiscard]] Outcome prepare(const Real& h);
  /// Allocates in advance what the first `prepare` would, unless the pattern is unknown, or large and dense.
  void reserve();
  void solve(Eigen::Ref<Mat<Real>> rhs) { solver_->solve(rhs); }
  SharedJacobian<Real>& shared() { return shared_; }
  /// See StageSolver. Returns false also if its factors are not those of the shared Jacobian and h.
  [[nodiscard]] bool solveReal(const Real& h, const Real& mu, Real* x) {
    return solver_ && version_ == shared_.version() && h_ == h && solver_->solveReal(mu, x);
  }

 private:
  void adopt(const std::shared_ptr<const Pattern>& pattern);

  SharedJacobian<Real>& shared_;
  StageSolverKind kind_;
  StageSolverSetup<Real> setup_;
  Counters& counters_;
  SolverOf of_;
  std::unique_ptr<CountedStageSolver<Real>> solver_;
  int version_ = 0;
  Real h_{};
};

/// A Newton matrix with derivatives of each stage, for full Newton. A large dense one (s n above 300) is allocated at
/// its first use: as the fallback of `modified` it is usually never used.
template <class Real>
class StagewiseMatrix {
 public:
  StagewiseMatrix(SharedJacobian<Real>& shared, StageSolverSetup<Real> setup, Counters& counters);

  /// Allocates in advance what the first use would, unless it is large and dense or the pattern is unknown.
  void reserve();
  /// Evaluates and factorizes at the stages of the last residual of `eq`.
  [[nodiscard]] Outcome prepare(const StageEquations<Real>& eq, const Mat<Real>& W);
  void solve(Eigen::Ref<Mat<Real>> rhs) { solver_->solve(rhs); }

 private:
  void adopt(const std::shared_ptr<const Pattern>& pattern);

  SharedJacobian<Real>& shared_;
  StageSolverSetup<Real> setup_;
  Counters& counters_;
  std::vector<Linearization<Real>> at_;
  std::unique_ptr<CountedStageSolver<Real>> solver_;
};

}  // namespace irk
