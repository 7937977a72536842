// LU with partial pivoting that neither allocates after construction nor hides a zero pivot.
#pragma once

#include <Eigen/LU>

#include "core/outcome.h"
#include "core/scalar.h"

namespace irk {

/// T real or complex. Wraps Eigen's PartialPivLU; n fixed by the constructor.
template <class T>
class DenseLu {
 public:
  explicit DenseLu(Index n) : matrix_(n, n), lu_(n), scratch_(n) {}

  /// To be filled before `factorize`.
  Mat<T>& matrix() { return matrix_; }
  T* values() { return matrix_.data(); }

  [[nodiscard]] Outcome factorize() {
    if (!matrix_.allFinite()) return Outcome::kNotFinite;
    lu_.compute(matrix_);
    for (Index i = 0; i < matrix_.rows(); ++i) {
      if (lu_.matrixLU()(i, i) == T(0)) return Outcome::kSingular;
    }
    return Outcome::kSuccess;
  }

  /// In place; x has n entries, contiguous.
  void solve(T* x) {
    VecView<T> view(x, matrix_.rows());
    scratch_.noalias() = lu_.permutationP() * view;
    lu_.matrixLU().template triangularView<Eigen::UnitLower>().solveInPlace(scratch_);
    lu_.matrixLU().template triangularView<Eigen::Upper>().solveInPlace(scratch_);
    view = scratch_;
  }

 private:
  Mat<T> matrix_;
  Eigen::PartialPivLU<Mat<T>> lu_;
  Vec<T> scratch_;
};

}  // namespace irk
