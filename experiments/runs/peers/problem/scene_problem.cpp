#include "experiments/runs/peers/problem/scene_problem.h"

#include <algorithm>

namespace irk {

void PeerJacobian::writeFull(double* to, Index leading) const {
  const Index n = pattern->n;
  const double* from = values.data();
  for (Index j = 0; j < n; ++j) {
    double* const column = to + j * leading;
    for (Index i = 0; i < n; ++i) column[i] = pattern->full ? *from++ : 0;
  }
  if (pattern->full) return;
  forEach([to, leading](Index i, Index j, double value) { to[j * leading + i] = value; });
}

Evaluated SceneProblem::jacobian(double t, const double* y, const double* yp, double c, PeerJacobian& J, double* dfdt) {
  ++jacobians_;
  return evaluated(evaluateJacobian(t, y, yp, c, J, dfdt));
}

bool SceneProblem::stopped() { return stop_ && stop_(); }

void SceneProblem::count(Counters& counters) const {
  counters.residuals += asked_ + evaluations_.residuals;
  counters.dual_residuals += evaluations_.dual_residuals;
  counters.jacobians += jacobians_;
}

}  // namespace irk
