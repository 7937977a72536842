// Sparse factors of several matrices, stored side by side: one pass with vector instructions solves for all of them.
#pragma once

#include <span>
#include <vector>

#include "core/linear/sparse_lu.h"

namespace irk {

/// Solves with several matrices of one pattern and one order of pivots at a time. In a solve with sparse factors
/// each column waits for the result of the one before; solves with other matrices do not depend on it and use the
/// other lanes of a vector register. The factors are copied, those of real matrices first. Allocates in its
/// constructor, and when factors grow to more than twice the size that the analysis predicts.
class InterleavedLu {
 public:
  /// Right-hand side and solution for one matrix, n entries each: re for a real matrix, re + i sigma im for a
  /// complex one. The caller owns the numbers.
  struct Lane {
    double* re;
    double* im;  ///< nullptr for a real matrix
    double sigma;
    double inverse_sigma;
  };

  InterleavedLu(const SparseAnalysis& analysis, std::size_t matrices);

  /// Copies the factors. Returns false if they do not all have the same pivots; then solve with each matrix alone.
  [[nodiscard]] bool assign(std::span<const SparseLu<double>> real,
                            std::span<const SparseLu<std::complex<double>>> complex);
  /// Solves in place, with one lane for each matrix of the last `assign`, in the same order; that must have
  /// returned true.
  void solve(std::span<const Lane> lanes);

 private:
  /// Up to 8 matrices. Each entry holds the real parts, padded to `width`, then the imaginary parts.
  struct Group {
    std::size_t first, lanes, width;
    std::vector<double> l, u, inverse_diagonal;
  };
  template <int kWidth>
  void solveGroup(const Group& group, std::span<const Lane> lanes);

  const SparsePivots* pivots_ = nullptr;  // of the first matrix, and of all if shared_
  std::vector<int> versions_;             // of the pivots at their last comparison
  bool shared_ = false;                   // result of that comparison: all pivots are the same
  std::vector<Group> groups_;
  std::vector<double> work_;
};

}  // namespace irk
