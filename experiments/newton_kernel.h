// The parts of Newton's method alone, at the start of a scene: for timing each of them.
#pragma once

#include <memory>
#include <vector>

#include "core/stage_equations.h"
#include "core/stage_solver.h"
#include "experiments/run_spec.h"

namespace irk {

class NewtonKernel {
 public:
  /// `h`: the step that the Newton matrix is made for. Throws Misuse as `prepare`.
  NewtonKernel(const RunSpec& spec, double h);

  Index unknowns() const { return rhs_.rows(); }  ///< n, of one stage
  Index nonzeros() const { return at_.front().pattern->nonzeros(); }  ///< of D0, D1, D2 together
  std::size_t directions() const { return differentiator_.directions(); }  ///< of a Jacobian
  Index stages() const { return rhs_.cols(); }

  void residual();   ///< r at one point
  void jacobian();   ///< D0, D1, D2 at one point
  void factorize();  ///< the Newton matrix of all stages. Throws Misuse if it is singular
  void solve();      ///< with its factors, which must be there
  void iteration();  ///< residuals of all stages and a solve

  /// Evaluations of r, over the plain scalar, in one `jacobian`.
  std::int64_t residualsPerJacobian() const { return residuals_per_jacobian_; }

 private:
  Point<double> point() const { return pointOf(start_); }

  std::shared_ptr<const System<double>> system_;
  State<double> start_;
  double h_;
  Differentiator<double> differentiator_;
  std::vector<Linearization<double>> at_;
  Scheme<double> scheme_;
  StageEquations<double> equations_;
  std::unique_ptr<StageSolver<double>> solver_;
  Vec<double> r_;
  Mat<double> ones_, rhs_, W_, R_;
  std::int64_t residuals_per_jacobian_ = 0;
};

}  // namespace irk
