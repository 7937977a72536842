// The stage solver of the paper: one LU of the whole Newton matrix, s n x s n.
#pragma once

#include "core/linear/dense_lu.h"
#include "core/linear/sparse_lu.h"
#include "core/stage_solvers/stage_solver.h"

namespace irk {

/// Lu is DenseLu or SparseLu. Contracts: StageSolver.
template <class Real, template <class> class Lu>
class Coupled final : public StageSolver<Real> {
 public:
  explicit Coupled(const StageSolverSetup<Real>& setup);
  Outcome factorize(std::span<const Linearization<Real>> at, const Real& h) override;
  void solve(Eigen::Ref<Mat<Real>> rhs) override;

 private:
  StageSolverSetup<Real> setup_;
  Mat<Real> A2_;
  Vec<Real> scales_;
  Vec<Real> flat_;
  Lu<Real> lu_;
};

}  // namespace irk
