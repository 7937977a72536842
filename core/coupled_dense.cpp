#include "core/coupled_dense.h"

#include "core/multiprecision.h"

namespace irk {

template <class Real>
CoupledDense<Real>::CoupledDense(const StageSolverSetup<Real>& setup)
    : setup_(setup),
      A2_(setup.A * setup.A),
      scales_(setup.pattern->n),
      flat_(setup.A.rows() * setup.pattern->n),
      lu_(setup.A.rows() * setup.pattern->n) {}

template <class Real>
Outcome CoupledDense<Real>::factorize(std::span<const Linearization<Real>> at, const Real& h) {
  const Pattern& pattern = *setup_.pattern;
  const Index n = pattern.n;
  const Index s = setup_.A.rows();
  rowScales(setup_.row_powers, h, scales_);
  Mat<Real>& J = lu_.matrix();
  J.setZero();
  for (Index i = 0; i < s; ++i) {
    const Linearization<Real>& D = at[at.size() == 1 ? 0 : static_cast<std::size_t>(i)];
    for (Index j = 0; j < s; ++j) {
      const Real f0 = i == j ? Real(1) : Real(0);
      const Real f1 = h * setup_.A(i, j);
      const Real f2 = h * h * A2_(i, j);
      for (Index column = 0; column < n; ++column) {
        const auto c = static_cast<std::size_t>(column);
        for (Index k = pattern.column_start[c]; k < pattern.column_start[c + 1]; ++k) {
          const Index row = pattern.row[static_cast<std::size_t>(k)];
          J(i * n + row, j * n + column) =
              scales_[row] * (f0 * D.d0[k] + f1 * D.d1[k] + f2 * D.d2[k]);
        }
      }
    }
  }
  return lu_.factorize();
}

template <class Real>
void CoupledDense<Real>::solve(Eigen::Ref<Mat<Real>> rhs) {
  const Index n = rhs.rows();
  for (Index j = 0; j < rhs.cols(); ++j) flat_.segment(j * n, n) = rhs.col(j);
  lu_.solve(flat_);
  for (Index j = 0; j < rhs.cols(); ++j) rhs.col(j) = flat_.segment(j * n, n);
}

IRK_INSTANTIATE_CLASS(CoupledDense)

}  // namespace irk
