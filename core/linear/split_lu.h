// LU with partial pivoting of dense complex matrices, at the speed of matrix products.
#pragma once

#include <complex>
#include <vector>

#include "irk/outcome.h"
#include "irk/scalar.h"

namespace irk {

/// LU of a complex n x n matrix. Real and imaginary parts are matrices of their own ("planes"), so that all operations
/// on them are those of vectors of doubles. The factorization is recursive: the left half of the columns, the product
/// that brings the right half up to date, the right half; S. Toledo, SIAM J. Matrix Anal. Appl. 18 (1997) 1065-1081.
/// Allocates in its constructor only. No two threads may use one object at a time.
class SplitLu {
 public:
  explicit SplitLu(Index n);

  Index n() const { return n_; }
  /// Real and imaginary parts of column j, n entries each. Fill all columns before `factorize`, which overwrites them.
  double* re(Index j) { return data_.data() + j * stride_; }
  double* im(Index j) { return re(j) + plane_; }

  /// Returns kSuccess, kSingular or kNotFinite. After a failure `solve` must not be called.
  [[nodiscard]] Outcome factorize();
  /// Solves in place; x has n contiguous entries.
  void solve(std::complex<double>* x);

 private:
  Outcome factorize(Index first, Index count);
  Outcome factorizePanel(Index first, Index count);
  void exchangeRows(Index first_pivot, Index pivots, Index first, Index count);

  Index n_, rows_, stride_, plane_;  // rows_: the next multiple of 8; plane_: from a real to its imaginary part
  Vec<double> data_;                 // by columns of `stride_` numbers; the rows from n on are zero
  Vec<double> x_;                    // scratch of `solve`
  std::vector<Index> pivots_;
};

}  // namespace irk
