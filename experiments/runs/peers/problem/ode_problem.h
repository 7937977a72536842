// y' = f(t, y) with its derivatives: the form that ODE codes expect.
#pragma once

#include "experiments/runs/peers/problem/assembly.h"
#include "experiments/runs/peers/problem/scene_problem.h"

namespace irk {

/// The right-hand side f of a system in the formulation `first_order` (nu = nz = 0, residual f - k).
class OdeProblem final : public SceneProblem {
 public:
  OdeProblem(const System<double>& system, const ProblemOptions& options);

  Vec<double> perComponent(const Vec<double>& values, double rest) const override;
  StartReport begin(State<double>& state, bool new_run, PeerValues& to) override;
  void read(const PeerStep& step, State<double>& state) const override;
  void switching(double t, const double* y, const double* yp, double* g) override;

 protected:
  bool evaluateRates(double t, const double* y, double* f) override;
  bool evaluateResidual(double t, const double* y, const double* yp, double* r) override;
  bool evaluateJacobian(double t, const double* y, const double* yp, double c, PeerJacobian& J, double* dfdt) override;

 private:
  Point<double> point(double t, const double* y) const;
  bool differentiate(double t, const double* y, double* dfdy, double* dfdt);

  Vec<double> no_rates_;
  bool dense_;
  State<Dual<double>> dual_;
  Vec<Dual<double>> f_;
  // For a sparse Jacobian.
  Differentiator<double> differentiator_;
  Linearization<double> D_;
  Assembly assembly_;
};

}  // namespace irk
