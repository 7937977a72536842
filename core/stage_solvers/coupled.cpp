#include "core/stage_solvers/coupled.h"

#include <memory>
#include <type_traits>

#include "irk/multiprecision.h"

namespace irk {
namespace {

// Analyses s x s blocks that all have the pattern `block`. In a column the entries of the stages follow each other.
std::shared_ptr<const SparseAnalysis> analyse(const Pattern& block, Index s) {
  std::vector<int> column_start{0}, row;
  for (Index j = 0; j < s * block.n; ++j) {
    const auto c = static_cast<std::size_t>(j % block.n);
    for (Index i = 0; i < s; ++i) {
      for (int k = block.column_start[c]; k < block.column_start[c + 1]; ++k) {
        row.push_back(static_cast<int>(i * block.n) + block.row[static_cast<std::size_t>(k)]);
      }
    }
    column_start.push_back(static_cast<int>(row.size()));
  }
  return std::make_shared<const SparseAnalysis>(std::move(column_start), std::move(row));
}

template <class L, class Real>
L makeLu(const StageSolverSetup<Real>& setup) {
  const Index s = setup.A.rows();
  if constexpr (std::is_same_v<L, SparseLu<Real>>) {
    return L(analyse(*setup.pattern, s));
  } else {
    return L(s * setup.pattern->n);
  }
}

}  // namespace

template <class Real, template <class> class Lu>
Coupled<Real, Lu>::Coupled(const StageSolverSetup<Real>& setup)
    : setup_(setup),
      A2_(setup.A * setup.A),
      scales_(setup.pattern->n),
      flat_(setup.A.rows() * setup.pattern->n),
      lu_(makeLu<Lu<Real>>(setup)) {}

// Writes the entries column by column and, within a column, stage by stage. This is the order of a dense matrix, and
// that of `analyse`.
template <class Real, template <class> class Lu>
Outcome Coupled<Real, Lu>::factorize(std::span<const Linearization<Real>> at, const Real& h) {
  const Pattern& pattern = *setup_.pattern;
  const Index s = setup_.A.rows();
  rowScales(setup_.row_powers, h, scales_);
  Real* value = lu_.values();
  for (Index j = 0; j < s; ++j) {
    for (Index column = 0; column < pattern.n; ++column) {
      const auto c = static_cast<std::size_t>(column);
      for (Index i = 0; i < s; ++i) {
        const Linearization<Real>& D = at[at.size() == 1 ? 0 : static_cast<std::size_t>(i)];
        const Real f1 = h * setup_.A(i, j);
        const Real f2 = h * h * A2_(i, j);
        for (Index k = pattern.column_start[c]; k < pattern.column_start[c + 1]; ++k) {
          const Index row = pattern.row[static_cast<std::size_t>(k)];
          Real entry = f1 * D.d1[k] + f2 * D.d2[k];
          if (i == j) entry += D.d0[k];
          *value++ = scales_[row] * entry;
        }
      }
    }
  }
  return lu_.factorize();
}

template <class Real, template <class> class Lu>
void Coupled<Real, Lu>::solve(Eigen::Ref<Mat<Real>> rhs) {
  const Index n = rhs.rows();
  for (Index j = 0; j < rhs.cols(); ++j) flat_.segment(j * n, n) = rhs.col(j);
  lu_.solve(flat_.data());
  for (Index j = 0; j < rhs.cols(); ++j) rhs.col(j) = flat_.segment(j * n, n);
}

template class Coupled<double, DenseLu>;
template class Coupled<BigFloat, DenseLu>;
template class Coupled<double, SparseLu>;

}  // namespace irk
