// Finds singular positions of constraints on the way of an integration.
#pragma once

#include <string>

#include "core/derivatives/constraint_frame.h"
#include "core/newton/newton_matrix.h"
#include "irk/outcome.h"

namespace irk {

/// Where the gradients of the position constraints become dependent, branches of the motion meet (a rod as long as its
/// crank, a bead on crossing wires). The equations do not say which one the motion takes, and multipliers grow without
/// bound. Two things show such a position, at any tolerance and without a limit on a condition number:
///  - A motion that goes straight through it leaves with the opposite orientation of the gradients, at once: the turn
///    stays in one piece of the way however short it is. (At a regular position it spreads over the pieces.)
///  - A motion that turns into another branch passes it at a distance at which one Newton step no longer leads to the
///    constraints (ConstraintFrames::newtonRest): the violation of a bilinear constraint x y = e leaves 1/4 at the
///    vertex of this hyperbola, whatever e is. Elsewhere the rest is about half the violation times the curvature.
/// Owns scratch; steps allocate nothing. Evaluations are not counted.
template <class Real>
class SingularPositions {
 public:
  /// Keeps a reference to the system. `scale` as for the error norm.
  SingularPositions(const System<Real>& system, const Vec<double>& scale);

  /// Begins a run at a state. Where the constraints are dependent at this state, nothing is watched.
  void begin(const State<Real>& state);
  /// The same after the positions have jumped during the run.
  void restart(const State<Real>& state);
  /// Whether there is a singular position on the way of a step, the cubic polynomial through the positions and
  /// velocities at its ends. Nothing is evaluated while the gradients cannot have changed much: the step's Newton
  /// method has kept its `jacobian` because it contracts well, and the positions have moved by less than half the way
  /// in which, at the last rates, a gradient turns by 30 degrees or becomes dependent. (Newton's method alone does not
  /// tell: a step whose start values are exact converges with any Jacobian.)
  bool passes(const SharedJacobian<Real>& jacobian, const State<Real>& from, const State<Real>& to);
  /// Whether a singular position is the cause of a run's failure at `state` with this outcome: `passes` has found one,
  /// or steps could not go on and there is one ahead on the straight way of up to the largest step so far.
  bool explains(Outcome outcome, const State<Real>& state);
  /// The time and the constraint; empty before one is found.
  const std::string& found() const { return found_; }

 private:
  bool liesAhead(const State<Real>& state);
  bool lookAlong(const State<Real>& from, const State<Real>& to);
  bool isSingular(const ConstraintFrame& frame);
  bool isNear(const ConstraintFrame& a, const ConstraintFrame& b);
  double distance(const ConstraintFrame& from, ConstVec<Real> u) const;
  void keep();
  void move(const State<Real>& from, const State<Real>& to, double theta);
  bool report(const ConstraintFrame& at);

  ConstraintFrames<Real> frames_;
  ConstraintFrame last_, trial_, start_;
  Mat<double> scratch_;
  Vec<double> scale_;
  Vec<Real> u_;
  bool watches_ = false;
  double far_ = 0;  // no frame is needed within this distance from the last one
  int seen_ = 0;    // version of the Jacobian at the last frame
  double largest_ = 0;
  std::string found_;
};

}  // namespace irk
