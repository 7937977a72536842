// The K-form: the residual of all stages of one step, and the step's end.
#pragma once

#include "core/stages/scheme.h"
#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// The nonlinear system of one step, paper (2.5)-(2.7). Unknown W: n x s, column i = (a_i, k_i, z_i).
/// Owns the stages' u, v, x. Allocates only in its constructor.
template <class Real>
class StageEquations {
 public:
  /// Keeps references.
  StageEquations(const System<Real>& system, const Scheme<Real>& scheme, Summation summation,
                 int threads);

  /// A step of size h from `from`, which must outlive the step.
  void begin(const State<Real>& from, const Real& h);

  /// R (n x s), rows of constraints multiplied by h^-power. Columns before `scheme.first` are known
  /// stages and stay zero. False if a residual is not finite.
  [[nodiscard]] bool residual(const Mat<Real>& W, Mat<Real>& R);

  /// The stages' u, v, x of W, without a residual.
  void place(const Mat<Real>& W);
  /// Stage i as of the last `residual` or `place`, for stage-wise derivatives.
  Point<Real> stage(const Mat<Real>& W, Index i) const;
  /// The step's start and its middle (u, v, x by Taylor's formula from the start), for derivatives.
  Point<Real> start() const;
  Point<Real> middle();
  /// The stage of the start values W that is nearest to 0.6 h.
  Point<Real> predicted(const Mat<Real>& W);

  /// End of the step, paper (2.10), (2.11) with d = A^-T b. `compensated`: `to.carry` is what the
  /// additions lost, `from.carry` what those before have lost.
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
  const State<Real>* from_ = nullptr;
  Real h_{};
  Mat<Real> U_, V_, X_;
  Mat<Real> hA_, hhA2_;  // (h A)^T and (h^2 A^2)^T
  Vec<Real> hA1_, t_;
  Vec<Real> scales_;
  State<Real> middle_;
};

}  // namespace irk
