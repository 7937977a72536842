// The gradients of position constraints at one state: their rank, how they turn, and how well they determine a
// position.
#pragma once

#include "core/derivatives/point_buffers.h"
#include "irk/system.h"

namespace irk {

/// G^T = dg/du^T = Q R by Gram and Schmidt, with orthonormal columns of Q and a positive diagonal of R. Sizes: G^T and
/// Q nu x m, R m x m, u nu, with the nu positions and those m constraints of the scene that are not left out. Positions
/// are divided by their scale.
struct ConstraintFrame {
  double t = 0;  ///< in the time of the scene
  Vec<double> u;
  Mat<double> Gt, Q, R;
  Index rank = 0;  ///< how many gradients are independent of those before them, but for round-off
  bool finite = false;

  bool regular() const { return finite && rank == R.cols(); }
};

/// The product of the cosines of the angles between the spaces that two regular frames span, det(Qa^T Qb): 1 if no
/// gradient has turned; its sign is that of their orientation. It does not depend on the factors and combinations in
/// which the constraints are written. Along a curve the orientation changes its sign where one singular value of G goes
/// through zero (E. Allgower & K. Georg, Introduction to Numerical Continuation Methods, chapter 8). `scratch`: m x m.
double turned(const ConstraintFrame& a, const ConstraintFrame& b, Mat<double>& scratch);

/// Evaluates frames of one system. Owns scratch; `evaluate` and `curvature` allocate nothing.
template <class Real>
class ConstraintFrames {
 public:
  /// `system`: in any formulation; the first-order form is replaced by its inner system. Keeps a reference. `scale`:
  /// magnitudes of (u, v, x, z), as for the error norm; empty means 1.
  ConstraintFrames(const System<Real>& system, const Vec<double>& scale);

  Index constraints() const { return constraints_; }
  ConstraintFrame make() const;

  /// The positions u of a state, in the units of the system: nu numbers. The same for v.
  ConstVec<Real> positions(const State<Real>& state) const;
  ConstVec<Real> velocities(const State<Real>& state) const;

  /// The frame of `state` if its time and positions were t and u.
  void evaluate(const State<Real>& state, const Real& t, const Vec<Real>& u, ConstraintFrame& out);
  /// What one Newton step for g = 0 from the frame last evaluated leaves of its own length: |G^+ g(u - G^+ g)| / |G^+
  /// g|. By the theorem of Newton and Kantorovich there is a position with g = 0 nearby if it is below 1/4 (Deuflhard,
  /// Newton Methods for Nonlinear Problems, theorem 2.1: h0 < 1/2, twice this number). The frame has to be regular.
  double newtonRest(const ConstraintFrame& frame);
  /// Number of the constraint with the largest part in the combination of gradients that is nearest to zero, each
  /// divided by its length in `regular`. Allocates.
  Index weakest(const ConstraintFrame& frame, const ConstraintFrame& regular) const;

 private:
  void place(const State<Real>& state, const Real& t);
  void constraintsAt(const Vec<Real>& u, Vec<double>& g);
  void setPositions(const Vec<Real>& u);

  const System<Real>& outer_;   // of the states
  const System<Real>& system_;  // that is evaluated
  Index positions_, constraints_;
  std::vector<Index> rows_;  // of the constraints in the residual
  Vec<double> scale_;
  State<Real> at_;
  PointBuffers<Dual<Real>> dual_;
  Vec<Real> r_, moved_;
  Vec<double> g_, step_, rest_;
};

}  // namespace irk
