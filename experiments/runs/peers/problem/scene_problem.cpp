#include "experiments/runs/peers/problem/scene_problem.h"

#include <algorithm>

namespace irk {
namespace {

// Evaluations between two readings of the clock. A reading costs as much as a small residual.
constexpr std::int64_t kEvaluationsPerStop = 64;

Evaluated evaluated(bool finite) { return finite ? Evaluated::kDone : Evaluated::kNotFinite; }

}  // namespace

void PeerJacobian::writeFull(double* to, Index leading) const {
  const Index n = pattern->n;
  if (!pattern->full) {
    for (Index j = 0; j < n; ++j) std::fill_n(to + j * leading, n, 0);
  }
  forEach([to, leading](Index i, Index j, double value) { to[j * leading + i] = value; });
}

bool SceneProblem::over() { return asked_ % kEvaluationsPerStop == 0 && stopped(); }

Evaluated SceneProblem::rates(double t, const double* y, double* f) {
  ++asked_;
  return over() ? Evaluated::kStop : evaluated(evaluateRates(t, y, f));
}

Evaluated SceneProblem::residual(double t, const double* y, const double* yp, double* r) {
  ++asked_;
  return over() ? Evaluated::kStop : evaluated(evaluateResidual(t, y, yp, r));
}

Evaluated SceneProblem::jacobian(double t, const double* y, const double* yp, double c, PeerJacobian& J, double* dfdt) {
  ++jacobians_;
  return evaluated(evaluateJacobian(t, y, yp, c, J, dfdt));
}

void SceneProblem::count(Counters& counters) const {
  counters.residuals += evaluations_.residuals;
  counters.dual_residuals += evaluations_.dual_residuals;
  counters.jacobians += jacobians_;
}

}  // namespace irk
