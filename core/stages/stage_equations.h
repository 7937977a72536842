// The stage equations: the residual of all stages of one step, and the state at its end.
#pragma once

#include "core/stages/scheme.h"
#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// The nonlinear system of one step, paper (2.5)-(2.7). The unknown is W (n x s) with columns (a_i, k_i, z_i).
/// Owns the stages' u, v, x. Allocates only in its constructor.
template <class Real>
class StageEquations {
 public:
  /// Keeps references to the system and the scheme. `threads`: how many stages, or parts of
  /// their rows, are worked on at a time.
  StageEquations(const System<Real>& system, const Scheme<Real>& scheme, Summation summation, int threads);

  /// Begins a step of size h. Keeps a reference to `from`, which must not change during the step.
  void begin(const State<Real>& from, const Real& h);

  /// Writes the residuals of the stages W to R (n x s); rows of constraints are multiplied by h^-power. Columns
  /// before `scheme.first` belong to known stages and are zero. Returns false if a residual is not finite.
  [[nodiscard]] bool residual(const Mat<Real>& W, Mat<Real>& R);

  /// The same of the last stage alone, to r (n).
  [[nodiscard]] bool lastResidual(const Mat<Real>& W, Vec<Real>& r);

  /// Computes u, v, x of the stages W, without the residual.
  void place(const Mat<Real>& W);
  /// The point of stage i with u, v, x of the last `residual` or `place`; for stage-wise derivatives. Where the
  /// residual does not depend on v, this is the v of the start.
  Point<Real> stage(const Mat<Real>& W, Index i) const;
  /// Points for derivatives: the step's start, and its middle (u, v, x by Taylor's formula from the start), which is
  /// written to `at`.
  Point<Real> start() const;
  Point<Real> middle(State<Real>& at) const;
  /// The point of the stage nearest to 0.6 h, for the start values W.
  Point<Real> predicted(const Mat<Real>& W);

  /// Writes the state at the end of the step to `to`, paper (2.10), (2.11) with d = A^-T b. With compensated
  /// summation the round-off lost so far, `from.carry`, is added, and that lost here is stored in `to.carry`.
  void finish(const Mat<Real>& W, State<Real>& to);

  const Scheme<Real>& scheme() const { return scheme_; }
  const State<Real>& from() const { return *from_; }
  const Real& h() const { return h_; }
  const Sizes& sizes() const { return sizes_; }

 private:
  StagePoints<Real> points(const Mat<Real>& W) const;

  const System<Real>& system_;
  const Scheme<Real>& scheme_;
  Summation summation_;
  Sizes sizes_;
  int threads_;
  Index inner_;  // the stage of `predicted`
  bool scaled_;
  bool uses_velocity_;
  const State<Real>* from_ = nullptr;
  Real h_{};
  Mat<Real> U_, V_, X_;
  Mat<Real> hA_, hhA2_;  // (h A)^T and (h^2 A^2)^T
  Vec<Real> hA1_, t_;
  Vec<Real> scales_;
};

}  // namespace irk
