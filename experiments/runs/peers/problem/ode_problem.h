// y' = f(t, y) with its derivatives: the form that ODE codes expect.
#pragma once

#include "experiments/runs/peers/problem/assembly.h"
#include "experiments/runs/peers/problem/direct_rates.h"
#include "experiments/runs/peers/problem/scene_problem.h"

namespace irk {

/// The right-hand side f of a system in the formulation `first_order` (nu = nz = 0, residual f - k).
class OdeProblem final : public SceneProblem {
 public:
  OdeProblem(const System<double>& system, const ProblemOptions& options);

  StartReport begin(State<double>& state, bool new_run, PeerValues& to) override;
  void read(const PeerStep& step, State<double>& state) const override;
  void switching(double t, const double* y, const double* yp, double* g) override;
  void setDiscrete(const Vec<double>& d) override;
  Evaluated rates(double t, const double* y, double* f) override {
    if (over()) return Evaluated::kStop;
    return evaluated(direct_.known() ? direct_.evaluate(t, y, f) : evaluateForm(t, y, f));
  }

 protected:
  bool evaluateJacobian(double t, const double* y, const double* yp, double c, PeerJacobian& J, double* dfdt) override;

 private:
  Point<double> point(double t, const double* y) const;
  bool differentiate(double t, const double* y, double* dfdy, double* dfdt);

  bool evaluateForm(double t, const double* y, double* f);
  bool differentiateForm(double t, const double* y, double* dfdy, double* dfdt);

  Vec<double> no_rates_;
  bool dense_;
  DirectRates direct_;  // of the system that is in first-order form
  State<Dual<double>> dual_;
  Vec<Dual<double>> f_;
  // For a sparse Jacobian.
  Differentiator<double> differentiator_;
  Linearization<double> D_;
  Assembly assembly_;
};

}  // namespace irk
