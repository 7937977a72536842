// A system with its own unknowns as F(t, y, y') = 0 and as M y' = f(t, y).
#pragma once

#include "experiments/runs/peers/problem/assembly.h"
#include "experiments/runs/peers/problem/scene_problem.h"

namespace irk {

/// What both forms share: y begins with (u, v, x), and the first rows are those of u' = v.
class ImplicitProblem : public SceneProblem {
 public:
  ImplicitProblem(const System<double>& system, const ProblemOptions& options);

 protected:
  /// Index 1 or more of the algebraic unknown i.
  int indexOf(Index i) const;
  /// The layout for y = (u, v, x, z), or with `rates` y = (u, v, x, a, k, z).
  void setLayout(bool rates);
  StartReport makeConsistent(State<double>& state, bool new_run);
  /// The point with (u, v, x) of y; a, k and z are those of the pointers.
  Point<double> point(double t, const double* y, const double* a, const double* k, const double* z) const;

  DerivativeSource derivatives_;
  bool determined_;
  Vec<double> scale_;
  bool dense_;
  Differentiator<double> differentiator_;
  Linearization<double> D_;
  Assembly assembly_;
};

/// F(t, y, y') = 0 with y = (u, v, x, z): the rows are u' - v and the residual with a = v', k = x'.
class DaeProblem final : public ImplicitProblem {
 public:
  DaeProblem(const System<double>& system, const ProblemOptions& options);

  StartReport begin(State<double>& state, bool new_run, PeerValues& to) override;
  void read(const PeerStep& step, State<double>& state) const override;
  void switching(double t, const double* y, const double* yp, double* g) override;
  Evaluated residual(double t, const double* y, const double* yp, double* r) override;

 protected:
  bool evaluateJacobian(double t, const double* y, const double* yp, double c, PeerJacobian& J, double* dfdt) override;

 private:
  Point<double> at(double t, const double* y, const double* yp) const;
  bool differentiate(double t, const double* y, const double* yp, double c, double* J);

  bool at_once_;              // a full Jacobian, with c as part of the directions
  State<Dual<double>> dual_;  // between two calls its directions are 0
  Vec<Dual<double>> dual_residual_;
};

/// M y' = f(t, y). If the residual is D (a, k) + r(t; u, v, x, z) with a constant D: y = (u, v, x, z), M contains
/// I and -D, and f contains v and r. Else y = (u, v, x, a, k, z), M = diag(I, I, I, 0), and f = (v, a, k, residual).
class MassProblem final : public ImplicitProblem {
 public:
  /// `start` is the state near which D is found to be constant or not.
  MassProblem(const System<double>& system, const ProblemOptions& options, const State<double>& start);

  Vec<double> perComponent(const Vec<double>& values, double rest) const override;
  StartReport begin(State<double>& state, bool new_run, PeerValues& to) override;
  void read(const PeerStep& step, State<double>& state) const override;
  void switching(double t, const double* y, const double* yp, double* g) override;
  Evaluated rates(double t, const double* y, double* f) override;

 protected:
  bool evaluateJacobian(double t, const double* y, const double* yp, double c, PeerJacobian& J, double* dfdt) override;

 private:
  Point<double> at(double t, const double* y) const;
  void setMass();

  bool extended_;
  Vec<double> no_rates_;  // (a, k) = 0
};

}  // namespace irk
