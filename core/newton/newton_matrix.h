// D0, D1, D2 at one point, kept over steps; and Newton matrices built on them.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/linear/sparse_lu.h"
#include "core/stage_solvers/stage_solver.h"
#include "core/stages/stage_equations.h"

namespace irk {

/// The linearization that the step's solves share, with its age: one for all stages or, at
/// `each_stage`, one per stage. One per integrator.
template <class Real>
class SharedJacobian {
 public:
  SharedJacobian(const System<Real>& system, const Scheme<Real>& scheme, const IntegratorOptions& options,
                 Counters& counters);

  /// Evaluates at the start or middle of the step that `eq` has begun, or at one or all stages W.
  void evaluate(StageEquations<Real>& eq, const Mat<Real>& W);
  /// A new mode.
  void forget();
  /// A new integration.
  void forgetPattern();
  /// Ask for a new evaluation at the next step's start.
  void markStale() { stale_ = true; }
  bool stale() const { return stale_; }
  /// Whether it was evaluated for a step that began at t.
  bool evaluatedAt(const Real& t) const { return version_ > 0 && t_ == t; }

  std::span<const Linearization<Real>> at() const { return at_; }
  /// What factors for another step size cost, in steps. Dense factors cost n^3, the solves of a step n^2. Sparse
  /// factors cost little: 0, since steps that were kept for longer made nothing faster there (six scenes). After
  /// `evaluate`.
  double factorsCost() const {
    constexpr double kDenseUnknowns = 40;
    const auto& pattern = at_.front().pattern;  // null where each stage has its own matrices
    return pattern && pattern->full ? static_cast<double>(pattern->n) / kDenseUnknowns : 0;
  }
  int version() const { return version_; }
  Differentiator<Real>& differentiator() { return differentiator_; }
  /// Of a pattern of its own, for all that factorize one stage's matrices; null for a dense one.
  const std::shared_ptr<const SparseAnalysis>& analysis(const std::shared_ptr<const Pattern>& pattern);

 private:
  Differentiator<Real> differentiator_;
  std::vector<Linearization<Real>> at_;
  JacobianPoint point_;
  Counters& counters_;
  Real t_{};
  int version_ = 0;
  bool stale_ = true;
  std::shared_ptr<const Pattern> analysed_;
  std::shared_ptr<const SparseAnalysis> analysis_;  // of that
};

/// A factorization for one step size; refactorized when the shared Jacobian or h has changed. Its
/// solver is made when the pattern is known.
template <class Real>
class NewtonMatrix {
 public:
  /// The setup has no pattern. Throws Misuse for `eigen` with a defective A.
  NewtonMatrix(SharedJacobian<Real>& shared, StageSolverKind kind, StageSolverSetup<Real> setup, Counters& counters);

  /// Factors of the shared Jacobian for step h.
  [[nodiscard]] Outcome prepare(const Real& h);
  /// Allocates what the first `prepare` would, where the pattern is known and not large and dense.
  void reserve();
  void solve(Eigen::Ref<Mat<Real>> rhs) { solver_->solve(rhs); }
  SharedJacobian<Real>& shared() { return shared_; }
  /// See StageSolver; false also where its factors are not those of the shared Jacobian and h.
  [[nodiscard]] bool solveReal(const Real& h, const Real& mu, Real* x) {
    return solver_ && version_ == shared_.version() && h_ == h && solver_->solveReal(mu, x);
  }

 private:
  void adopt(std::shared_ptr<const Pattern> pattern);

  SharedJacobian<Real>& shared_;
  StageSolverKind kind_;
  StageSolverSetup<Real> setup_;
  Counters& counters_;
  std::unique_ptr<StageSolver<Real>> solver_;
  int version_ = 0;
  Real h_{};
};

/// A Newton matrix with the derivatives of each stage: full Newton. A large dense one (s n above
/// 300) is allocated when it is first needed: as the fallback of `modified` it usually never is.
template <class Real>
class StagewiseMatrix {
 public:
  /// `used`: by the Newton method, at least as a last resort.
  StagewiseMatrix(SharedJacobian<Real>& shared, StageSolverSetup<Real> setup, bool used, Counters& counters);

  /// Allocates what the first use would, where it is not too large and the pattern is known.
  void reserve();
  /// Evaluates and factorizes at the stages of the last residual of `eq`.
  [[nodiscard]] Outcome prepare(const StageEquations<Real>& eq, const Mat<Real>& W);
  void solve(Eigen::Ref<Mat<Real>> rhs) { solver_->solve(rhs); }

 private:
  void adopt(std::shared_ptr<const Pattern> pattern);

  SharedJacobian<Real>& shared_;
  StageSolverSetup<Real> setup_;
  bool used_;
  Counters& counters_;
  std::vector<Linearization<Real>> at_;
  std::unique_ptr<StageSolver<Real>> solver_;
};

}  // namespace irk
